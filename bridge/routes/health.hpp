// Whether a station answers, and when a silent one is asked again. Health belongs to a station of a line.
#pragma once

#include "protocols/time.hpp"

#include <cstdint>
#include <string_view>

namespace plcgw {

enum class health : std::uint8_t {
    healthy,
    suspect,  // the last exchange failed: only that question is asked again, without retries
    down,     // silent twice in a row: probed with a growing interval
};

constexpr std::string_view to_string(health h)
{
    switch (h) {
    case health::healthy: return "healthy";
    case health::suspect: return "suspect";
    case health::down: return "down";
    }
    return "unknown";
}

class station_health {
public:
    // seed: stations with different ones are probed at different times, so that those that were lost together are not
    // asked together ever after.
    explicit station_health(std::uint32_t seed = 0) : jitter_(seed) {}

    health state() const { return state_; }
    time_point probe_at() const { return probe_at_; }  // of a station that is down

    void answered();  // also "no": an exception is an answer
    void failed(time_point now);
    void doubted();  // healthy becomes suspect: somebody else got no answer

private:
    health state_ = health::healthy;
    duration interval_{};
    time_point probe_at_{};
    std::uint32_t jitter_;
};

}  // namespace plcgw
