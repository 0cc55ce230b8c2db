#include "bridge/routes/health.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration first_probe = std::chrono::seconds(1);
constexpr duration last_probe = std::chrono::seconds(30);

}  // namespace

void station_health::answered()
{
    state_ = health::healthy;
    interval_ = {};
}

void station_health::failed(time_point now)
{
    if (state_ == health::healthy) {
        state_ = health::suspect;
        return;
    }
    state_ = health::down;
    interval_ = interval_ == duration{} ? first_probe : std::min(2 * interval_, last_probe);
    probe_at_ = now + interval_;
}

}  // namespace plcgw
