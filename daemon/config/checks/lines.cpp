#include "bridge/plc/model.hpp"
#include "daemon/config/checks/checks.hpp"

#include <algorithm>
#include <filesystem>

namespace plcgw::config {
namespace {

// One spelling of each path. Symbolic links stay: their ports come and go.
std::string port_of(const line_config& l) { return std::filesystem::path(l.device).lexically_normal().string(); }

using port_users = std::map<std::string, std::vector<std::string>>;  // of each port: the lines so far

void check_unit_plc(check_context& c, const std::string& at, const unit_config& unit, line_protocol protocol)
{
    const plc::model* const model = c.model_of(unit.plc);
    if (model == nullptr)
        return;
    const bool exists = std::any_of(model->channels.begin(), model->channels.end(),
                                    [&](const plc::channel& each) { return each.number == unit.channel; });
    if (!exists)
        c.complain(at + "/channel", "is a channel that a " + std::string(model->name) + " does not have");
    if (protocol == line_protocol::modbus_ascii && !model->ascii)
        c.complain(at + "/plc", "is a " + std::string(model->name) + ", which speaks RTU only, on an ASCII line");
}

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

void check_server_line(check_context& c, std::size_t i, const line_config& l, bool serial)
{
    if (!serial)
        c.complain(item("lines", i, "role"), "is server, but a MODBUS TCP server stands under \"modbus_tcp\"");
    if (l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i), "serves nobody: give \"units\"");
    check_units(c, item("lines", i, "units"), l.units);
    for (std::size_t u = 0; u < l.units.size(); ++u) {
        const std::string at = item("lines", i, "units") + "/" + std::to_string(u);
        if (!l.units[u].line.empty())
            c.complain(at + "/line", "forwards from a serial line, which this version cannot: give \"plc\"");
        if (l.units[u].unit < 1 || l.units[u].unit > 247)
            c.complain(at + "/unit", "is not within 1 to 247, the unit ids of a serial line");
        check_unit_plc(c, at, l.units[u], l.protocol);
    }
}

void check_line(check_context& c, port_users& users, std::size_t i, const line_config& l)
{
    const bool serial = l.protocol != line_protocol::modbus_tcp;
    if (c.is_sound(item("lines", i)))
        check_way(c, i, l, serial);
    if (l.role == line_role::server)
        check_server_line(c, i, l, serial);
    else if (!l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i, "units"), "stands at a client line: its stations are listed under \"stations\"");
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
