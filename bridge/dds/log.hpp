// Cyclone's own log, for the log of the program that uses it.
#pragma once

#include <functional>
#include <string>

namespace plcgw {

enum class dds_log_level { info, warning, error };
using dds_log_handler = std::function<void(dds_log_level, const std::string&)>;

// One handler for the process, set before the first publisher or subscriber; without one Cyclone is silent. It gets at
// most 10 lines a minute, then "N more suppressed" before the next one. It may be called on Cyclone's threads, with
// Cyclone's locks held: it must not wait and not call anything of DDS; post the line to the loop.
void set_dds_log(dds_log_handler handler);

}  // namespace plcgw
