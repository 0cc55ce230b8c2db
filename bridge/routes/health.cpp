#include "bridge/routes/health.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration first_probe = std::chrono::seconds(1);
constexpr duration last_probe = std::chrono::seconds(30);
constexpr std::uint32_t most_jitter = 20;  // percent by which an interval is shorter at most

// The next of a fixed sequence (Numerical Recipes' constants): the same run in virtual time every time.
std::uint32_t next_of(std::uint32_t& sequence) { return (sequence = sequence * 1'664'525U + 1'013'904'223U) >> 16U; }

}  // namespace

void station_health::answered()
{
    state_ = health::healthy;
    interval_ = {};
}

void station_health::doubted()
{
    if (state_ == health::healthy)
        state_ = health::suspect;
}

void station_health::failed(time_point now)
{
    if (state_ == health::healthy) {
        state_ = health::suspect;
        return;
    }
    state_ = health::down;
    interval_ = interval_ == duration{} ? first_probe : std::min(2 * interval_, last_probe);
    probe_at_ = now + interval_ - interval_ * (next_of(jitter_) % most_jitter) / 100;
}

}  // namespace plcgw
