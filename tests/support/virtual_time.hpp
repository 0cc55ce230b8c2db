// Tests pass time in: they begin at t0 and never sleep.
#pragma once

#include "protocols/time.hpp"

namespace plcgw::test {

using namespace std::chrono_literals;

inline constexpr time_point t0{std::chrono::hours(1)};

}  // namespace plcgw::test
