// `plc-gateway plc-link`: the stations of the PLC links, asked of the running gateway over its control socket.
#pragma once

#include "daemon/plc_links.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace plcgw {

// The gateway's side. links: null when the configuration has none.
nlohmann::json plc_link_command(const plc_links* links, time_point now);

// The command line's side. Prints the links, or what is wrong; returns the exit status. socket: empty = where it
// usually is.
int plc_link_client(const std::string& socket);

}  // namespace plcgw
