// Requests and replies as they go between DDS clients and gateways.
#pragma once

#include "bridge/orders/order_log.hpp"

#include <string>

namespace plcgw {

struct order_request {
    order_key key;
    std::string gateway;
    order what;
    std::string malformed{};  // why it is none; `what` counts only if this is empty
};

struct order_reply {
    order_key key;
    std::string gateway;
    std::string member;
    order_outcome outcome;
    wall_time done{};
};

}  // namespace plcgw
