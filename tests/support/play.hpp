// Plays a line's schedule in virtual time: asks, lets each exchange take its time, sleeps until the schedule wants to
// wake.
#pragma once

#include "bridge/routes/schedule.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <vector>

namespace plcgw::test {

struct ending {
    schedule::outcome how{};
    duration took{};
};

inline ending answers(duration took) { return {schedule::outcome::answered, took}; }
inline ending silent(duration took) { return {schedule::outcome::silent, took}; }

// `exchange` says how the turn that begins now ends: ending(const schedule::turn&, time_point now).
template <class Exchange>
time_point play(schedule& s, time_point now, time_point until, Exchange exchange)
{
    while (now < until) {
        if (const auto turn = s.next(now)) {
            const ending e = exchange(*turn, now);
            now += e.took;
            s.finished(*turn, e.how, e.took, now);
            continue;
        }
        const time_point wake = s.wake_at(now);
        REQUIRE(wake > now);  // else the line would spin
        now = std::min(wake, until);
    }
    return now;
}

using turns = std::vector<std::size_t>;

// The items of the next n turns, each answered after `took`.
inline turns next_turns(schedule& s, time_point& now, int n, duration took = 10ms)
{
    turns items;
    for (int i = 0; i < n; ++i) {
        const auto turn = s.next(now);
        if (!turn)
            break;
        items.push_back(turn->item);
        now += took;
        s.finished(*turn, schedule::outcome::answered, took, now);
    }
    return items;
}

inline void fail(schedule& s, time_point& now, std::size_t item, duration took = 500ms)
{
    const auto turn = s.next(now);
    REQUIRE(turn.has_value());
    CHECK(turn->item == item);
    now += took;
    s.finished(*turn, schedule::outcome::silent, took, now);
}

}  // namespace plcgw::test
