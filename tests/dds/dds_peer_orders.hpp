// A client whose requests follow each other: what it sent and every reply that it heard, a line of JSON each.
#pragma once

#include "bridge/dds/settings.hpp"
#include "bridge/orders/order.hpp"

namespace plcgw::test {

// Request N writes the value N into that register of the route, N from 1 on; each is repeated every 100 ms until its
// reply comes, then the next one follows at once. Ends with the standard input, when the last one was answered.
int give_orders(const dds_settings& settings, const std::string& gateway, const std::string& client,
                route_order target);

}  // namespace plcgw::test
