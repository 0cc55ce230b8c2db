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

bool has_messages(const line_config& l)
{
    const general_purpose_config& g = l.messages;
    return !g.received.empty() || !g.messages.empty() || !g.sends.empty() || g.dds_sends;
}

void check_general_purpose_line(check_context& c, std::size_t i, const line_config& l)
{
    if (l.role == line_role::server)
        c.complain(item("lines", i, "role"), "is server, which a general-purpose line cannot be");
    if (!l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i, "units"), "stands at a general-purpose line, where nobody has a unit id");
    if (!has_messages(l) && c.is_sound(item("lines", i)))
        c.complain(item("lines", i),
                   "does nothing: give \"general_purpose\" with received, messages, sends or dds_sends");
}

void check_line(check_context& c, port_users& users, std::size_t i, const line_config& l)
{
    const bool serial = l.protocol != line_protocol::modbus_tcp;
    if (c.is_sound(item("lines", i)))
        check_way(c, i, l, serial);
    if (l.protocol == line_protocol::general_purpose)
        check_general_purpose_line(c, i, l);
    else if (l.role == line_role::server)
        check_server_line(c, i, l);
    else if (!l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i, "units"), "stands at a client line: its stations are listed under \"stations\"");
    if (is_mewtocol(l.protocol))
        check_mewtocol(c, i, l);
    if (l.protocol != line_protocol::general_purpose && has_messages(l) && c.is_sound(item("lines", i)))
        c.complain(item("lines", i, "general_purpose"), "stands at a line whose \"protocol\" is not general-purpose");
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
    for (std::size_t i = 0; i < c.config.lines.size(); ++i)
        check_line(c, users, i, c.config.lines[i]);
}

}  // namespace plcgw::config
