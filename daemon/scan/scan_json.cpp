#include "daemon/scan/scan_json.hpp"

#include "daemon/scan/unit_list.hpp"

#include <nlohmann/json.hpp>

namespace plcgw {
namespace {

using nlohmann::json;

std::string_view text_of(scanned_area::says what)
{
    switch (what) {
    case scanned_area::says::values: return "values";
    case scanned_area::says::refused: return "refused";
    case scanned_area::says::nothing: break;
    }
    return "nothing";
}

json area_json(const scanned_area& from)
{
    json made{{"area", area_name(from.first)}, {"says", text_of(from.what)}};
    if (const auto* const device = std::get_if<mewtocol::device>(&from.first))
        made["source"] = mewtocol::to_string(*device);
    if (!from.reason.empty())
        made["reason"] = from.reason;
    return made;
}

json finding_json(const scan_finding& from)
{
    json made{{"unit", number(from.unit)}, {"what", from.is_damaged ? "damaged" : "found"}, {"areas", json::array()}};
    for (const scanned_area& each : from.areas)
        made["areas"].push_back(area_json(each));
    if (from.is_damaged)
        made["reason"] = from.damage;
    if (!from.identification.empty())
        made["identification"] = from.identification;
    return made;
}

json configured_json(const station& from, health state)
{
    return {{"unit", number(from.unit)},
            {"what", "configured"},
            {"name", from.name},
            {"health", to_string(state)},
            {"areas", json::array()}};
}

}  // namespace

json line_json(const line_config& line)
{
    json made{{"name", line.name}, {"protocol", name_of(line.protocol)}};
    if (line.device.empty()) {
        made["host"] = line.host;
        made["port"] = line.port;
    }
    else {
        made["device"] = line.device;
    }
    if (line.protocol == line_protocol::modbus_tcp)
        return made;
    made["baud_rate"] = line.baud_rate;
    made["data_bits"] = line.data_bits;
    made["parity"] = name_of(line.check);
    made["stop_bits"] = line.stop_bits;
    return made;
}

json scan_json(running_line& line, time_point now)
{
    client_line& routes = line.routes;
    const station_scan* const scan = routes.look_at_scan(now);
    json made{{"line", line_json(line.config)}, {"port_open", routes.is_port_open()}, {"stations", json::array()}};
    for (std::size_t i = 0; i < routes.stations().size(); ++i)
        if (!routes.stations()[i].name.empty())
            made["stations"].push_back(configured_json(routes.stations()[i], routes.health_of(i)));
    if (scan == nullptr) {
        made["state"] = "none";
        return made;
    }
    made["state"] = scan->is_over() ? "done" : routes.is_scanning() ? "running" : "stopped";
    made["units_asked"] = scan->units_asked();
    made["units_total"] = scan->units_total();
    made["questions"] = scan->questions();
    made["disturbed"] = scan->disturbed();
    for (const scan_finding& each : scan->found())
        made["stations"].push_back(finding_json(each));
    return made;
}

void begin_scan(running_line& line, const std::vector<unsigned>& units, std::optional<milliseconds> timeout,
                time_point now)
{
    const line_protocol protocol = line.config.protocol;
    std::vector<station_number> asked;
    for (unsigned unit = lowest_unit(protocol); unit <= highest_unit(protocol) && units.empty(); ++unit)
        asked.emplace_back(unit);
    for (const unsigned unit : units)
        asked.emplace_back(unit);
    const auto language = is_mewtocol(protocol) ? scan_language::mewtocol : scan_language::modbus;
    line.routes.begin_scan(language, std::move(asked), timeout, now);
    line.driver->wake();
}

}  // namespace plcgw
