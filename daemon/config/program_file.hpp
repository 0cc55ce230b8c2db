// The program of a PLC: in the configuration, or in a file of its own.
#pragma once

#include "daemon/config/config.hpp"

namespace plcgw::config {

// folder: of the configuration; program_file is relative to it. Nothing when the file cannot be read.
std::optional<std::string> program_text(const plc_config& c, const std::string& folder);

}  // namespace plcgw::config
