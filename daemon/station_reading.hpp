// Stations and routes of a configuration as the planner wants them.
#pragma once

#include "bridge/routes/read_plan.hpp"
#include "daemon/config/config.hpp"

namespace plcgw {

station_place place_of(const route_config& r);  // of a configuration without mistakes

read_settings reading_of(const line_config& line, const station_config& station);

// A station of a client line, and its read routes in their order.
struct station_wants {
    const station_config* station{};
    std::vector<const route_config*> routes;
    std::vector<wanted_read> wanted;
    read_settings how;
};

std::vector<station_wants> wants_of(const gateway_config& all, const line_config& line);

// Whether the line polls stations.
bool polls(const line_config& line);

}  // namespace plcgw
