// A scan of a line as JSON: what the running gateway answers, what --json prints, and what tables and stubs are made
// of.
#pragma once

#include "daemon/running_line.hpp"

#include <nlohmann/json_fwd.hpp>

namespace plcgw {

// The scan that the line has, or had last. "state": "running", "done", "stopped", or "none" before the first one.
nlohmann::json scan_json(running_line& line, time_point now);

// The keys of this line's settings as in a configuration.
nlohmann::json line_json(const line_config& line);

// Starts one. units: empty = all that the protocol has.
void begin_scan(running_line& line, const std::vector<unsigned>& units, std::optional<milliseconds> timeout,
                time_point now);

}  // namespace plcgw
