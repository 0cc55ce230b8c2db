// Where a unit id of a server leads: to a simulated PLC, to a station of a line, or nowhere.
#pragma once

#include "daemon/forward_gate.hpp"

#include <array>

namespace plcgw {

struct unit_target {
    plc::simulated_plc* plc = nullptr;  // answers from its memory
    forward_gate* line = nullptr;       // forwards to that unit of the line
    station_number unit;                // on that line
};

using unit_table = std::array<unit_target, 256>;  // neither: exception 0A, there is no path

}  // namespace plcgw
