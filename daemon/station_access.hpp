// Registers and devices of a station itself, past all routes: read and written as forwarded requests are.
#pragma once

#include "bridge/orders/order.hpp"
#include "daemon/running_line.hpp"

namespace plcgw {

// An order that has not begun in time is withdrawn.
asio::awaitable<order_outcome> write_station(running_line& line, station_order o, time_point begin_by);

// values: filled when the outcome is good.
struct station_reading_result {
    order_outcome outcome;
    order_values values;
};
asio::awaitable<station_reading_result> read_station(running_line& line, station_number unit, station_place first,
                                                     std::uint32_t count, time_point begin_by);

}  // namespace plcgw
