// What makes a message on a general-purpose line (GPSEND and GPRECV): FP7 serial communication manual 9.2.1.
#pragma once

#include "protocols/serial_timing.hpp"

#include <ratio>

namespace plcgw::general_purpose {

namespace ascii {
inline constexpr std::uint8_t stx = 0x02;
inline constexpr std::uint8_t etx = 0x03;
inline constexpr std::uint8_t line_feed = 0x0A;
inline constexpr std::uint8_t carriage_return = 0x0D;
}  // namespace ascii

// Bytes of a message with its start and end codes, received or sent (1.3 and 9.3.2).
inline constexpr std::size_t max_message_size = 4096;

// Units of 0.01 ms, as the PLC's settings count them: 0 to 10000.
using hundredths = std::chrono::duration<std::uint32_t, std::ratio<1, 100'000>>;
inline constexpr hundredths longest_setting{10'000};

// The values are those of PMGET, words D+8 and D+9 (10.3.2).
enum class start_code : std::uint8_t { none, stx };
enum class end_code : std::uint8_t { cr, cr_lf, silence, etx };

struct message_form {
    start_code start = start_code::none;
    end_code end = end_code::cr;
    duration silence{};  // of end_code::silence, as end_silence() says
    // Not of the PLC: a message that never got its end code is dropped after this silence; 0 = never, as the PLC does.
    duration abandon{};
};

// The silence that ends a message; 0 stands for the time of 32 bits (10.3.2, D+10).
constexpr duration end_silence(hundredths setting, const character_format& format)
{
    constexpr std::uint64_t bits = 32;
    if (setting.count() != 0)
        return setting;
    return duration{static_cast<std::int64_t>((bits * 1'000'000 + format.baud_rate - 1) / format.baud_rate)};
}

}  // namespace plcgw::general_purpose
