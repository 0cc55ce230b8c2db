#include "bridge/orders/order.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration patience = std::chrono::seconds(10);  // with orders that say no timeout

}  // namespace

std::string_view to_string(order_result r)
{
    switch (r) {
    case order_result::ok: return "OK";
    case order_result::rejected: return "REJECTED";
    case order_result::not_found: return "NOT_FOUND";
    case order_result::expired: return "EXPIRED";
    case order_result::device_error: return "DEVICE_ERROR";
    case order_result::timeout: return "TIMEOUT";
    case order_result::busy: return "BUSY";
    case order_result::standby: return "STANDBY";
    case order_result::denied: return "DENIED";
    }
    return "UNKNOWN";
}

bool is_whole(const order_values& v)
{
    const std::size_t needed = v.are_bits ? (std::size_t{v.count} + 15) / 16 : v.count;
    return v.count != 0 && v.words.size() == needed;
}

time_point begin_by(const order& o, time_point now, wall_time wall)
{
    const duration within = o.timeout == duration{} ? patience : o.timeout;
    if (static_cast<std::int64_t>(o.given) <= 0)  // not said, or nonsense
        return now + within;
    const std::chrono::nanoseconds age(static_cast<std::int64_t>(wall) - static_cast<std::int64_t>(o.given));
    return now + within - std::max(duration{}, std::chrono::duration_cast<duration>(age));
}

}  // namespace plcgw
