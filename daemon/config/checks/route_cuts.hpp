// What a MEWTOCOL route asks of its station, and where that is cut into commands.
#pragma once

#include "daemon/config/config.hpp"
#include "protocols/mewtocol/block.hpp"

namespace plcgw::config {

mewtocol::block block_of(const route_config& r, const mewtocol::device& first, direction way);

// In bits of the PLC's memory, from the route's first. line: of its station, if known. way: read or write.
std::vector<std::size_t> cuts_of(const route_config& r, const line_config* line, direction way);

}  // namespace plcgw::config
