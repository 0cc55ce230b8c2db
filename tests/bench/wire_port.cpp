#include "tests/bench/wire_port.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <unistd.h>

namespace plcgw::bench {

wire_port::wire_port(std::filesystem::path link, wire on) : link_(std::move(link)), wire_(std::move(on))
{
    if (std::filesystem::is_symlink(link_))
        std::filesystem::remove(link_);
    std::filesystem::create_symlink(pty_.device, link_);
}

wire_port::~wire_port()
{
    std::error_code ignored;
    std::filesystem::remove(link_, ignored);
}

void wire_port::hand_over(nanoseconds now, stillness& machine)
{
    if (deadline() > now)
        return;
    machine.note_late(now - deadline());
    const byte_vector chunk = wire_.due(now);
    [[maybe_unused]] const auto written = ::write(fd(), chunk.data(), chunk.size());
}

void wire_port::listen(nanoseconds now)
{
    std::array<std::uint8_t, 1024> room{};
    const auto size = ::read(fd(), room.data(), room.size());
    if (size > 0)
        wire_.heard(now, byte_span(room).first(static_cast<std::size_t>(size)));
}

nlohmann::json wire_port::report()
{
    nlohmann::json said = wire_.window().report();
    said["link"] = link_.filename();
    said["baud"] = wire_.format().baud;
    said["rule_us"] = static_cast<double>(wire_.format().rule()) / 1000;
    return said;
}

}  // namespace plcgw::bench
