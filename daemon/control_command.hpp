// What the control socket knows: each command goes to its own file.
#pragma once

#include "daemon/plc_command.hpp"
#include "daemon/plc_links.hpp"

#include <nlohmann/json_fwd.hpp>

namespace plcgw {

// links: null when the configuration has none.
nlohmann::json control_command(const plc_list& plcs, const plc_links* links, const nlohmann::json& what,
                               time_point now);

}  // namespace plcgw
