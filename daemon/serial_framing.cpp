#include "daemon/serial_framing.hpp"

#include <algorithm>

namespace plcgw {

serial_framing::serial_framing(modbus::framing mode, std::vector<modbus::unit_id> own, duration silence)
    : mode_(mode), own_(std::move(own)), in_(mode, own_, silence)
{
}

std::string_view serial_framing::name() const
{
    return mode_ == modbus::framing::ascii ? "MODBUS ASCII" : "MODBUS RTU";
}

std::optional<result<modbus::tcp_frame>> serial_framing::next(time_point now)
{
    while (auto event = in_.next(now)) {
        const modbus::unit_id unit = event->content.unit;
        const bool ours = unit == modbus::unit_id::broadcast || std::find(own_.begin(), own_.end(), unit) != own_.end();
        if (event->what == modbus::bus_event::kind::question && ours)
            return modbus::tcp_frame{.id = {}, .content = std::move(event->content)};
    }
    return std::nullopt;
}

void serial_framing::append(buffer& to, const modbus::tcp_frame& answer) const
{
    const buffer adu = modbus::encode_adu(mode_, answer.content, modbus::ascii_delimiter);
    to.insert(to.end(), adu.begin(), adu.end());
}

}  // namespace plcgw
