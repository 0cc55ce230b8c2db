// What `plc-gateway read` and `write` are pointed at: a point by its name, devices of a PLC (main:D100), or registers
// and devices of a station itself (meter/holding:100, press/DT100; bus#7/holding:100 for one that is not configured).
#pragma once

#include "bridge/orders/order.hpp"
#include "daemon/config/config.hpp"

namespace plcgw {

struct point_target {
    std::string name;
};

struct device_target {
    std::string plc;
    std::string device;
};

struct station_target {
    std::string line;
    station_number unit;
    station_place first;
};

using access_target = std::variant<point_target, device_target, station_target>;

// Else what is wrong with it, and what would do.
boost::system::result<access_target, order_outcome> parse_target(const std::string& text, const gateway_config& config);

}  // namespace plcgw
