#include "daemon/config/checks/line_checks.hpp"

#include <filesystem>

namespace plcgw::config {
namespace {

// One spelling of each path. Symbolic links stay: their ports come and go.
std::string port_of(const line_config& l) { return std::filesystem::path(l.device).lexically_normal().string(); }

using port_users = std::map<std::string, std::vector<std::string>>;  // of each port: the lines so far

// A line goes over a serial port or to a host.
void check_way(check_context& c, std::size_t i, const line_config& l, bool serial)
{
    if (!serial && l.host.empty())
        c.complain(item("lines", i), "lacks \"host\": the address of a MODBUS TCP server");
    else if (!serial && !l.device.empty())
        c.complain(item("lines", i, "device"), "stands at a MODBUS TCP line, which has no serial port");
    else if (l.device.empty() && l.host.empty())
        c.complain(item("lines", i),
                   "lacks \"device\": the path of a serial port, or \"host\": a device server's address");
    else if (!l.device.empty() && !l.host.empty())
        c.complain(item("lines", i, "host"), "stands beside \"device\": a line has one of them");
}

void check_line(check_context& c, port_users& users, com_port_users& com_ports, std::size_t i, const line_config& l)
{
    const bool serial = l.protocol != line_protocol::modbus_tcp;
    if (c.is_sound(item("lines", i)))
        check_way(c, i, l, serial);
    if (l.role == line_role::server)
        check_server_line(c, com_ports, i, l);
    else if (!l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i, "units"), "stands at a client line: its stations are listed under \"stations\"");
    if (is_mewtocol(l.protocol))
        check_mewtocol(c, i, l);
    if (l.data_bits != 8 && l.protocol == line_protocol::modbus_rtu)
        c.complain(item("lines", i, "data_bits"), "is 7, but MODBUS RTU needs 8 data bits");
    if (l.device.empty())
        return;
    std::vector<std::string>& lines = users[port_of(l)];
    for (const std::string& other : lines)
        c.complain(item("lines", i, "device"),
                   "is already the device of line \"" + other + "\": a port belongs to one line");
    lines.push_back(l.name);
}

}  // namespace

void check_lines(check_context& c)
{
    port_users users;
    com_port_users com_ports;
    for (std::size_t i = 0; i < c.config.lines.size(); ++i)
        check_line(c, users, com_ports, i, c.config.lines[i]);
}

}  // namespace plcgw::config
