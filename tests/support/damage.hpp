// What can happen to a frame on its way, besides being cut (every_cut.hpp).
#pragma once

#include "protocols/bytes.hpp"

namespace plcgw::test {

inline buffer with_bit_flipped(buffer frame, std::size_t bit)
{
    frame[bit / 8] = static_cast<std::uint8_t>(frame[bit / 8] ^ 1U << (bit % 8));
    return frame;
}

inline buffer without_byte(buffer frame, std::size_t at)
{
    frame.erase(frame.begin() + static_cast<std::ptrdiff_t>(at));
    return frame;
}

inline buffer twice(buffer frame)
{
    frame.reserve(2 * frame.size());
    frame.insert(frame.end(), frame.begin(), frame.end());
    return frame;
}

}  // namespace plcgw::test
