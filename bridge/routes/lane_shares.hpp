// Who gets a line next when several kinds of work wait: in the order of the lanes, but none for more than its share of
// the time while another waits.
#pragma once

#include "protocols/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace plcgw {

enum class lane : std::uint8_t { write, forward, poll, probe, scan };  // in the order in which they go

inline constexpr std::size_t lane_count = 5;

// Each lane has an account in microseconds of line time: it grows by the lane's share of the time that passes, never
// above zero, and falls by what the lane's transactions take. A lane below zero has had its share.
class lane_shares {
public:
    bool has_credit(lane of, time_point now) const { return credit(of, now) >= 0; }
    time_point credit_from(lane of) const;  // when it has credit, if it asks nothing until then; max() never occurs

    void spent(lane of, duration took, time_point now);  // a transaction that ended now

private:
    struct account {
        double credit = 0;  // at `since`
        time_point since{};
    };
    double credit(lane of, time_point now) const;

    std::array<account, lane_count> accounts_{};
};

}  // namespace plcgw
