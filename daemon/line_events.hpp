// What the routes of a line have to say, for the log.
#pragma once

#include "bridge/routes/client_line.hpp"

namespace plcgw {

void log_events(const std::vector<line_event>& events);

}  // namespace plcgw
