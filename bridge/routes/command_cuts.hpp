// Where a long MEWTOCOL route is cut into commands, whose values belong to different moments.
#pragma once

#include "bridge/routes/bus_cost.hpp"

#include <vector>

namespace plcgw {

// The words or contacts of the block, counted from 0, at which another command begins. Empty: one command carries all,
// or the block cannot be asked.
std::vector<std::size_t> command_cuts(const bus_timing& bus, const mewtocol::block& asked);

}  // namespace plcgw
