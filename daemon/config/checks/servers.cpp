#include "daemon/config/checks/checks.hpp"
#include "daemon/config/ip_address.hpp"

namespace plcgw::config {
namespace {

void check_port(check_context& c, std::size_t i, const tcp_server_config& s)
{
    const auto address = ip_address(s.listen);
    for (std::size_t other = 0; other < i; ++other) {
        const auto taken = ip_address(c.config.modbus_tcp[other].listen);
        if (c.config.modbus_tcp[other].port != s.port || !address || !taken || !exclude_each_other(*address, *taken))
            continue;
        if (c.is_sound(item("modbus_tcp", i)) && c.is_sound(item("modbus_tcp", other)))
            c.complain(item("modbus_tcp", i, "port"), "is " + std::to_string(s.port) + ", which " +
                                                          item("modbus_tcp", other) +
                                                          " takes already: listen on another port or address");
    }
}

// As on a serial line: no unit 0, which is the broadcast, and ASCII only for PLCs that have it.
void check_serial_units(check_context& c, std::size_t i, const tcp_server_config& s)
{
    for (std::size_t u = 0; u < s.units.size(); ++u) {
        const std::string at = item("modbus_tcp", i, "units") + "/" + std::to_string(u);
        if (s.units[u].unit < 1 || s.units[u].unit > 247)
            c.complain(at + "/unit", "is not within 1 to 247, the unit ids of a serial line");
        if (s.framing == server_framing::ascii)
            check_ascii(c, at + "/plc", s.units[u].plc);
    }
    if (s.framing == server_framing::ascii)
        check_ascii(c, item("modbus_tcp", i, "other_units"), s.other_units);
}

void check_server(check_context& c, std::size_t i, const tcp_server_config& s)
{
    if (!ip_address(s.listen))
        c.complain(item("modbus_tcp", i, "listen"), "is \"" + s.listen + "\", expected an IP address such as 0.0.0.0");
    check_port(c, i, s);
    if (c.lines.find(s.other_units) != nullptr)
        check_client_line(c, s.other_units, item("modbus_tcp", i, "other_units"));
    else if (!s.other_units.empty())
        c.plc(s.other_units, item("modbus_tcp", i, "other_units"));
    if (s.units.empty() && s.other_units.empty() && c.is_sound(item("modbus_tcp", i)))
        c.complain(item("modbus_tcp", i), "leads to no PLC: give \"units\" or \"other_units\"");
    check_units(c, item("modbus_tcp", i, "units"), s.units);
    if (s.framing != server_framing::tcp)
        check_serial_units(c, i, s);
}

}  // namespace

void check_servers(check_context& c)
{
    for (std::size_t i = 0; i < c.config.modbus_tcp.size(); ++i)
        check_server(c, i, c.config.modbus_tcp[i]);
}

}  // namespace plcgw::config
