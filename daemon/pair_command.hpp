// `plc-gateway pair`: both members of a pair, asked of a running gateway over its control socket, and handing over.
#pragma once

#include "daemon/standby.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace plcgw {

// The gateway's side. member: null when the configuration has no pair.
nlohmann::json pair_command(standby_member* member, const nlohmann::json& what);

// The command line's side. action: "show" or "switch". Prints both members, or what is wrong; returns the exit status.
// socket: empty = where it usually is.
int pair_client(const std::string& socket, const std::string& action);

}  // namespace plcgw
