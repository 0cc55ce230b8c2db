// The two byte types that every protocol takes and returns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plcgw {

using bytes = std::span<const std::uint8_t>;  // input: somebody else's memory
using buffer = std::vector<std::uint8_t>;     // output: returned by value, frames are small

}  // namespace plcgw
