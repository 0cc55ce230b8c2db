#include "protocols/modbus/bus_framer.hpp"

namespace plcgw::modbus {
namespace {

using parts = std::variant<rtu_bus_framer, ascii_framer>;

parts make(framing mode, std::vector<unit_id> own, duration max_silence)
{
    if (mode == framing::ascii)
        return ascii_framer();
    return rtu_bus_framer(std::move(own), max_silence);
}

bus_event to_event(result<frame> heard)
{
    if (!heard)
        return {.what = bus_event::kind::dropped, .content = {}, .why = static_cast<errc>(heard.error().value())};
    return {.what = bus_event::kind::question, .content = std::move(*heard), .why = {}};
}

}  // namespace

bus_framer::bus_framer(framing mode, std::vector<unit_id> own, duration max_silence)
    : in_(make(mode, std::move(own), max_silence))
{
}

void bus_framer::feed(time_point now, bytes received)
{
    std::visit([&](auto& in) { in.feed(now, received); }, in_);
}

std::optional<bus_event> bus_framer::next(time_point now)
{
    if (auto* const rtu = std::get_if<rtu_bus_framer>(&in_))
        return rtu->next(now);
    auto heard = std::get<ascii_framer>(in_).next(now);
    return heard ? std::optional(to_event(std::move(*heard))) : std::nullopt;
}

time_point bus_framer::deadline() const
{
    return std::visit([](const auto& in) { return in.deadline(); }, in_);
}

time_point bus_framer::heard() const
{
    return std::visit([](const auto& in) { return in.heard(); }, in_);
}

void bus_framer::set_delimiters(buffer any_of)
{
    if (auto* const ascii = std::get_if<ascii_framer>(&in_))
        ascii->set_delimiters(std::move(any_of));
}

std::uint8_t bus_framer::delimiter() const
{
    const auto* const ascii = std::get_if<ascii_framer>(&in_);
    return ascii != nullptr ? ascii->delimiter() : ascii_delimiter;
}

}  // namespace plcgw::modbus
