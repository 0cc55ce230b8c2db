// How long a station takes to answer, and the timeout that follows from it.
#pragma once

#include "protocols/time.hpp"

#include <optional>

namespace plcgw {

// Smoothed response time and its deviation, as TCP does it (RFC 6298), from answers to requests that were not repeated.
class response_times {
public:
    void add(duration response_time);

    std::optional<duration> mean() const { return mean_; }

    // Mean plus four deviations, within these bounds; the longest until enough answers were timed.
    duration timeout(duration shortest, duration longest) const;

private:
    std::optional<duration> mean_;
    duration deviation_{};
    unsigned count_ = 0;
};

}  // namespace plcgw
