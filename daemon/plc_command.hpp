// `plc-gateway plc`: the switch and the power of the simulated PLCs, inside the running gateway and outside.
#pragma once

#include "bridge/plc/simulated_plc.hpp"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <vector>

namespace plcgw {

using plc_list = std::vector<std::unique_ptr<plc::simulated_plc>>;

// Inside: {"command": "plc", "action": "list" | "run" | "stop" | "power-cycle", "name": "main"}.
nlohmann::json plc_command(const plc_list& plcs, const nlohmann::json& what);

// Outside: sends that to the gateway and prints the states of its PLCs. socket: empty = where it usually is. Exit
// status 0; 1 when the gateway does not run or refuses.
int plc_client(const std::string& socket, const std::string& action, const std::string& name);

}  // namespace plcgw
