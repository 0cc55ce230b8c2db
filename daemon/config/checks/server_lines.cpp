#include "daemon/config/checks/line_checks.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

struct number_row {
    line_protocol protocol;
    unsigned most;
    const char* what;
};

constexpr number_row numbers[] = {
    {line_protocol::modbus_rtu, 247, "the unit ids of a serial line"},
    {line_protocol::modbus_ascii, 247, "the unit ids of a serial line"},
    {line_protocol::mewtocol_com, 99, "the stations of MEWTOCOL-COM"},
    {line_protocol::mewtocol7_com, 999, "the stations of MEWTOCOL7-COM"},
};

void check_number(check_context& c, const std::string& at, unsigned unit, line_protocol protocol)
{
    for (const number_row& row : numbers)
        if (row.protocol == protocol && (unit < 1 || unit > row.most))
            c.complain(at + "/unit", "is not within 1 to " + std::to_string(row.most) + ", " + row.what);
}

void check_unit_plc(check_context& c, const std::string& at, const unit_config& unit, line_protocol protocol)
{
    const plc::model* const model = c.model_of(unit.plc);
    if (model == nullptr)
        return;
    const bool exists = std::any_of(model->channels.begin(), model->channels.end(),
                                    [&](const plc::channel& each) { return each.number == unit.channel; });
    if (!exists)
        c.complain(at + "/channel", "is a channel that a " + std::string(model->name) + " does not have");
    if (protocol == line_protocol::modbus_ascii)
        check_ascii(c, at + "/plc", unit.plc);
    if (is_mewtocol(protocol) && !model->mewtocol)
        c.complain(at + "/plc", "is a " + std::string(model->name) + ", which does not speak MEWTOCOL: an FP7 does");
}

}  // namespace

void check_server_line(check_context& c, std::size_t i, const line_config& l)
{
    if (l.protocol == line_protocol::modbus_tcp)
        c.complain(item("lines", i, "role"), "is server, but a MODBUS TCP server stands under \"modbus_tcp\"");
    if (l.units.empty() && c.is_sound(item("lines", i)))
        c.complain(item("lines", i), "serves nobody: give \"units\"");
    check_units(c, item("lines", i, "units"), {l.units.begin(), l.units.end()});
    for (std::size_t u = 0; u < l.units.size(); ++u) {
        const std::string at = item("lines", i, "units") + "/" + std::to_string(u);
        if (!l.units[u].line.empty() && is_mewtocol(l.protocol))
            c.complain(at + "/line", "forwards MEWTOCOL, which is not possible: give \"plc\"");
        check_number(c, at, l.units[u].unit, l.protocol);
        check_unit_plc(c, at, l.units[u], l.protocol);
    }
}

}  // namespace plcgw::config
