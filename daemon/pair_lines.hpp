// The lines of a gateway as its pair sees them.
#pragma once

#include "bridge/standby/pair_line.hpp"
#include "daemon/config/config.hpp"

#include <optional>

namespace plcgw {

// One on which the members hear each other ask: a serial port, as client.
bool is_heard_line(const line_config& line);

// The shortest period of what is read on it; nothing: only written, or on demand.
std::optional<milliseconds> shortest_period(const gateway_config& all, const line_config& line);

pair_line_settings pair_line_of(const gateway_config& all, const line_config& line);

}  // namespace plcgw
