// Time is a parameter: protocols and bridge never read a clock, so every timing rule is tested as arithmetic.
#pragma once

#include <chrono>
#include <cstdint>

namespace plcgw {

using duration = std::chrono::microseconds;
using time_point = std::chrono::time_point<std::chrono::steady_clock, duration>;

// Wall-clock time of a value, nanoseconds since 1970-01-01T00:00:00Z (registers.idl: source_ns). 0 = never.
enum class wall_time : std::int64_t { never = 0 };

}  // namespace plcgw
