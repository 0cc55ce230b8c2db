// Asks the running gateway over its control socket.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace plcgw {

// The gateway's reply; {"ok": false, "unreachable": true, "error": ...} when nobody answers there. socket: empty =
// where it usually is.
nlohmann::json ask_gateway(const std::string& socket, const nlohmann::json& command);

}  // namespace plcgw
