// Which devices of a PLC's memory an order means, and whether they may be written.
#pragma once

#include "bridge/orders/memory_write.hpp"
#include "bridge/plc_block.hpp"
#include "bridge/routes/route.hpp"

namespace plcgw {

using found_span = boost::system::result<write_span, order_outcome>;

// A part of what the route's RegisterBlock shows.
found_span part_of(const route& r, const route_order& o);
found_span part_of(const plc_block& b, const route_order& o);

// "D100" and as many as the values are: words into word devices, bits into bit devices.
found_span devices_of(plc::simulated_plc& plc, const device_order& o);

}  // namespace plcgw
