// How long things take on an asynchronous serial line.
#pragma once

#include "protocols/time.hpp"

#include <cstddef>
#include <cstdint>

namespace plcgw {

enum class parity : std::uint8_t { none, odd, even };

// Two-wire adapters may return what they send.
enum class local_echo : std::uint8_t {
    off,
    on,         // the request comes back first and is removed
    automatic,  // removed where it cannot be the answer: that of functions 05, 06 and 08 has the same bytes
};

struct character_format {
    unsigned baud_rate = 19200;  // bits per second
    unsigned data_bits = 8;      // 5 to 8
    parity check = parity::even;
    unsigned stop_bits = 1;  // 1 or 2
};

// Bits of one character on the wire: start, data, parity, stop.
constexpr unsigned bits_per_character(const character_format& f)
{
    return 1 + f.data_bits + (f.check == parity::none ? 0 : 1) + f.stop_bits;
}

// Time of n characters on the wire, rounded up to whole microseconds.
constexpr duration character_time(const character_format& f, std::size_t n)
{
    const std::uint64_t bits = std::uint64_t{n} * bits_per_character(f) * 1'000'000;
    return duration{static_cast<std::int64_t>((bits + f.baud_rate - 1) / f.baud_rate)};
}

// The silence that ends a frame: 3.5 characters, fixed at 1750 us above 19200 bit/s
// (MODBUS over Serial Line V1.02 section 2.5.1.1).
constexpr duration frame_gap(const character_format& f)
{
    if (f.baud_rate > 19200)
        return duration{1750};
    const std::uint64_t half_bits = std::uint64_t{7} * bits_per_character(f) * 1'000'000;
    return duration{static_cast<std::int64_t>((half_bits + 2 * f.baud_rate - 1) / (2 * f.baud_rate))};
}

}  // namespace plcgw
