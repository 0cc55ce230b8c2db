// A wire is hardware: nothing else on the machine makes it late. Without the right to that, it is only a busy process.
#pragma once

#include "tests/bench/wire_format.hpp"

#include <ctime>
#include <sched.h>
#include <sys/prctl.h>

namespace plcgw::bench {

inline nanoseconds now()
{
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * nanoseconds{1'000'000'000} + time.tv_nsec;
}

inline bool become_urgent()
{
    const sched_param urgent{.sched_priority = 2};
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    return ::sched_setscheduler(0, SCHED_FIFO, &urgent) == 0;
}

}  // namespace plcgw::bench
