// Mistakes that no single value shows: names that lead nowhere, devices that do not exist, things that stand twice.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/config/located_json.hpp"

namespace plcgw::config {

// folder: for program_file.
void check(const gateway_config& c, const located_json& file, const std::string& folder, mistakes& found);

}  // namespace plcgw::config
