#include "daemon/scan/scan_command.hpp"

#include "daemon/scan/scan_json.hpp"
#include "daemon/scan/unit_list.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr unsigned longest_timeout_ms = 10'000;

json refusal(std::string why) { return {{"ok", false}, {"error", std::move(why)}}; }

json start(running_line& line, const json& what, bool is_active, time_point now)
{
    if (!is_active)
        return refusal(
            "this gateway is the standby of a pair and asks nobody: scan with the active member, `plc-gateway "
            "pair` says which that is");
    const line_protocol protocol = line.config.protocol;
    const auto units = what.value("units", std::vector<unsigned>());
    for (const unsigned each : units)
        if (each < lowest_unit(protocol) || each > highest_unit(protocol))
            return refusal(fmt::format("unit {} cannot be on line {}: its stations have the numbers {} to {}", each,
                                       line.config.name, lowest_unit(protocol), highest_unit(protocol)));
    std::optional<milliseconds> timeout;
    if (what.contains("timeout_ms")) {
        timeout = milliseconds(what["timeout_ms"].get<unsigned>());
        if (timeout->count() == 0 || timeout->count() > longest_timeout_ms)
            return refusal(
                fmt::format("timeout_ms is {}, but 1 to {} are possible", timeout->count(), longest_timeout_ms));
    }
    line.routes.look_at_scan(now);
    if (line.routes.is_scanning())
        return refusal(fmt::format("line {} is being scanned already: wait until that is over", line.config.name));
    if (!line.routes.is_port_open())
        return refusal(fmt::format("the port or connection of line {} is absent now", line.config.name));
    begin_scan(line, units, timeout, now);
    return {{"ok", true}};
}

json carry_out(running_line& line, const json& what, bool is_active, time_point now)
{
    const std::string action = what.value("action", "status");
    json reply{{"ok", true}};
    if (action == "start")
        reply = start(line, what, is_active, now);
    else if (action == "stop")
        line.routes.end_scan();
    else if (action != "status")
        return refusal(fmt::format("unknown action \"{}\": start, status or stop", action));
    if (reply["ok"] == true)
        reply.update(scan_json(line, now));
    return reply;
}

}  // namespace

json scan_command(const std::vector<std::unique_ptr<running_line>>& lines, const json& what, bool is_active,
                  time_point now)
{
    try {
        const std::string name = what.value("line", "");
        std::string names;
        for (const auto& each : lines) {
            if (each->config.name == name)
                return carry_out(*each, what, is_active, now);
            names.append(names.empty() ? "" : ", ").append(each->config.name);
        }
        return refusal(fmt::format("the gateway asks on no line \"{}\", but on: {}", name, names));
    }
    catch (const json::exception& wrong) {  // a member of another type
        return refusal(fmt::format("a scan command cannot be read: {}", wrong.what()));
    }
}

}  // namespace plcgw
