// Times on the emulated wire: nanoseconds of CLOCK_MONOTONIC, so that the rounding of many characters adds up to
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plcgw::bench {

using nanoseconds = std::int64_t;
using byte_span = std::span<const std::uint8_t>;
using byte_vector = std::vector<std::uint8_t>;

// When the receiver's driver hands over what it has received.
enum class delivery : std::uint8_t {
    byte,   // each byte when its stop bit ends
    fifo,   // a 16550: at the trigger level, and 4 character times after the last byte
    frame,  // a response as a whole when its last byte ends
};

struct wire_format {
    unsigned baud = 19200;
    unsigned bits = 11;  // of a character: start, data, parity, stop
    delivery how = delivery::byte;

    // From the start of a burst to the end of its count-th character.
    constexpr nanoseconds characters(std::int64_t count) const
    {
        return count * bits * 1'000'000'000 / static_cast<std::int64_t>(baud);
    }

    // The least silence before a request: 3.5 characters, 1.75 ms above 19200 bit/s.
    constexpr nanoseconds rule() const { return baud > 19200 ? 1'750'000 : characters(7) / 2; }
};

}  // namespace plcgw::bench
