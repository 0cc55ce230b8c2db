// Keeps a flood of log lines short: Cyclone can log one line for each write, and a rogue peer two a second.
#pragma once

#include "protocols/time.hpp"

#include <optional>
#include <utility>

namespace plcgw {

class log_limiter {
public:
    log_limiter(unsigned most, duration window) : most_(most), window_(window) {}

    // Nothing: drop this line. Otherwise the number of lines that were dropped since the last one.
    std::optional<unsigned> admit(time_point now)
    {
        if (!started_ || now - *started_ >= window_) {
            started_ = now;
            admitted_ = 0;
        }
        if (admitted_ == most_) {
            ++suppressed_;
            return {};
        }
        ++admitted_;
        return std::exchange(suppressed_, 0);
    }

private:
    unsigned most_;
    duration window_;
    std::optional<time_point> started_;
    unsigned admitted_ = 0;
    unsigned suppressed_ = 0;
};

}  // namespace plcgw
