// `plc-gateway watch --device D100`: which blocks, routes and points contain a device of a PLC.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/watch_filter.hpp"

namespace plcgw {

// "D100" or "main.D100". Without a configuration only blocks of PLCs are found, whose names say where they are. Returns
// what is wrong with the text, or nothing.
std::string filter_by_device(const std::string& text, const std::optional<gateway_config>& config,
                             watch_filter& filter);

}  // namespace plcgw
