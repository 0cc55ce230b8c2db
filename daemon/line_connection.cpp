#include "daemon/line_connection.hpp"

#include "daemon/serial_connection.hpp"
#include "daemon/tcp_connection.hpp"

#include <algorithm>

namespace plcgw {

std::unique_ptr<line_connection> make_connection(asio::io_context& loop, const line_config& line)
{
    if (line.device.empty())
        return std::make_unique<tcp_connection>(loop, line);
    return std::make_unique<serial_connection>(loop, line);
}

character_format format_of(const line_config& line)
{
    return {line.baud_rate, line.data_bits, line.check, line.stop_bits};
}

duration silence_of(const line_config& line)
{
    constexpr milliseconds least_over_network{50};
    return line.host.empty() ? line.silence : std::max(line.silence, least_over_network);
}

modbus::framing framing_of(const line_config& line)
{
    return line.protocol == line_protocol::modbus_ascii ? modbus::framing::ascii : modbus::framing::rtu;
}

local_echo echo_of(const line_config& line)
{
    return line.rs485.enabled && line.rs485.rx_during_tx ? local_echo::on : line.echo;
}

// Adapters deliver in packets, networks take their time.
duration echo_time(const line_config& line, std::size_t size)
{
    constexpr duration port_delay = std::chrono::milliseconds(100);
    constexpr duration network_delay = std::chrono::seconds(1);
    return character_time(format_of(line), size) + (line.device.empty() ? network_delay : port_delay);
}

}  // namespace plcgw
