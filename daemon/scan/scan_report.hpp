// What a scan found, for people: a table, what it means, and a configuration to begin with.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace plcgw {

// All of these take an array of what scan_json() made: one for each combination of protocol, rate and format.
std::string scan_table(const nlohmann::json& scans);
std::vector<std::string> scan_hints(const nlohmann::json& scans);
std::size_t stations_in(const nlohmann::json& scans);  // that answered, or are configured

// A configuration that `plc-gateway check` accepts, with comments: the line, as it was when most stations answered,
// these stations, and for each table or area that gave values a route that reads its first item, as an example.
std::string scan_stub(const nlohmann::json& scans);

}  // namespace plcgw
