// Two gateways of the same name that stand in for each other.
#pragma once

#include <chrono>
#include <optional>

namespace plcgw {

struct standby_config {
    std::optional<unsigned> priority;  // nothing: this gateway has no pair
    bool hand_back = true;
    std::chrono::milliseconds lease{500};
    std::chrono::milliseconds line_silence{2000};
    std::chrono::milliseconds listen{2000};
    std::chrono::milliseconds hand_back_after{5000};

    bool is_configured() const { return priority.has_value(); }
};

}  // namespace plcgw
