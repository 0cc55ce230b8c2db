#include "daemon/plc_command.hpp"

#include "daemon/control_client.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace plcgw {
namespace {

using nlohmann::json;

json refusal(std::string why) { return {{"ok", false}, {"error", std::move(why)}}; }

json state_of(const plc::simulated_plc& plc)
{
    json state{{"name", plc.name()},
               {"model", plc.model().name},
               {"state", plc.state() == plc::run_state::run ? "RUN" : "STOP"}};
    if (const auto& fault = plc.fault())
        state["fault"] = fmt::format("error 202, detail {}: {}", fault->detail, fault->reason);
    return state;
}

std::string names_of(const plc_list& plcs)
{
    std::string names;
    for (const auto& each : plcs)
        names.append(names.empty() ? "" : ", ").append(each->name());
    return names;
}

}  // namespace

json plc_command(const plc_list& plcs, const json& what)
{
    const std::string action = what.value("action", "list");
    const std::string name = what.value("name", "");
    if (what.value("command", "") != "plc")
        return refusal("unknown command: this version knows \"plc\", \"plc-link\", \"read\", \"write\" and \"send\"");

    if (action != "list") {
        const auto plc = std::find_if(plcs.begin(), plcs.end(), [&](const auto& each) { return each->name() == name; });
        if (plc == plcs.end())
            return refusal(fmt::format("there is no PLC \"{}\", but: {}", name, names_of(plcs)));
        if (action == "run")
            (*plc)->run();
        else if (action == "stop")
            (*plc)->stop();
        else if (action == "power-cycle")
            (*plc)->power_cycle();
        else
            return refusal(fmt::format("unknown action \"{}\": run, stop, power-cycle or list", action));
    }
    json states = json::array();
    for (const auto& each : plcs)
        if (name.empty() || each->name() == name)
            states.push_back(state_of(*each));
    return {{"ok", true}, {"plcs", std::move(states)}};
}

int plc_client(const std::string& socket, const std::string& action, const std::string& name)
{
    const json reply = ask_gateway(socket, {{"command", "plc"}, {"action", action}, {"name", name}});
    if (!reply.value("ok", false)) {
        fmt::print(stderr, "plc-gateway: {}\n", reply.value("error", "the gateway did not understand"));
        return 1;
    }
    for (const json& each : reply["plcs"]) {
        fmt::print("{:<16} {:<8} {}", each.value("name", ""), each.value("model", ""), each.value("state", ""));
        if (each.contains("fault"))
            fmt::print("  {}", each.value("fault", ""));
        fmt::print("\n");
    }
    return 0;
}

}  // namespace plcgw
