// The protocols, baud rates and formats that a scan on a port of its own tries.
#pragma once

#include "daemon/scan/scan_client.hpp"

namespace plcgw {

// The common ones first.
struct scan_combinations {
    std::vector<line_config> lines;
    int status = 0;  // not 0: the options make no sense, which was said
};

// A line of a configuration is scanned as it is, a port in all the common ways, unless the options say more.
scan_combinations combinations_of(const scan_options& o, const line_config& base);

}  // namespace plcgw
