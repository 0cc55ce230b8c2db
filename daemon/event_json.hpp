// What a subscriber hears, as JSON for scripts.
#pragma once

#include "bridge/dds/event.hpp"

#include <string>

namespace plcgw {

std::string json_line(const dds_event& event);  // one object and its line break

}  // namespace plcgw
