#include "bridge/routes/response_times.hpp"

#include <algorithm>
#include <chrono>

namespace plcgw {
namespace {

constexpr unsigned enough = 8;
constexpr int mean_weight = 8;       // RFC 6298: alpha = 1/8
constexpr int deviation_weight = 4;  // beta = 1/4
constexpr int deviations = 4;        // K

}  // namespace

void response_times::add(duration response_time)
{
    count_ = std::min(count_ + 1, enough);
    if (!mean_) {
        mean_ = response_time;
        deviation_ = response_time / 2;
        return;
    }
    deviation_ += (std::chrono::abs(*mean_ - response_time) - deviation_) / deviation_weight;
    *mean_ += (response_time - *mean_) / mean_weight;
}

duration response_times::timeout(duration shortest, duration longest) const
{
    if (count_ < enough)
        return longest;
    return std::clamp(*mean_ + deviations * deviation_, std::min(shortest, longest), longest);
}

}  // namespace plcgw
