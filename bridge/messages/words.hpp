// Messages in the words of a PLC, FP7 serial communication manual 9.3.2 and 9.4.2: the count of bytes in the first
// word, then the bytes, the first of two in the low byte of its word.
#pragma once

#include "protocols/general_purpose/encode.hpp"

#include <span>

namespace plcgw::messages {

using words = std::span<std::uint16_t>;
using const_words = std::span<const std::uint16_t>;

inline constexpr std::uint16_t send_failed = 0xFFFF;  // result word of GPSEND in place of the bytes sent (9.3.3)

// The count and the bytes alone.
constexpr std::size_t words_of(std::size_t bytes_in_message) { return 1 + (bytes_in_message + 1) / 2; }

// Bytes without a count: two in a word, the rest of the area becomes zero. They must fit.
void pack(bytes from, words area);

// What GPRECV does. The high byte behind the last of an odd number of bytes is 0; words behind the message keep what
// they held. errc::overlong: the area is too small, and is left alone. Returns the words written.
result<std::size_t> store_message(bytes message, words area);

struct outgoing {
    buffer content;
    general_purpose::ending how{};
};

// What GPSEND does: 1 to 4094 bytes; a negative count, -1 to -4096, sends them without an end code (9.3.4).
// errc::bad_count: another count, or more than the area has.
result<outgoing> message_in(const_words area);

}  // namespace plcgw::messages
