// What a plan costs, and why its requests end where they do: for those who read it.
#pragma once

#include "bridge/routes/read_plan.hpp"

namespace plcgw {

// Bus time over time that a poll takes.
double share_of(const planned_poll& p);

// One row for each poll but the last of its area: why the next one is not in the same request. Empty between areas.
std::vector<std::string> why_apart(const read_plan& plan, const std::vector<wanted_read>& wanted,
                                   const read_settings& how, const station_limits& limits);

// A date and time in UTC, "2023-11-14 22:13".
std::string date_of(wall_time t);

}  // namespace plcgw
