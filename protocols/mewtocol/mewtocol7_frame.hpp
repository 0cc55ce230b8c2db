// A frame of MEWTOCOL7-COM between its header `>` and CR: station, frame number, text, CRC. FP7 serial communication
// manual 11.3.
#pragma once

#include "protocols/errc.hpp"
#include "protocols/mewtocol/frame.hpp"

namespace plcgw::mewtocol7 {

using mewtocol::check;
using mewtocol::error_code;

// 1 to 999. `any`: the only server of a one-to-one line answers, whatever its number. There is no global station.
enum class station_id : std::uint16_t { none = 0, any = 0xEEE };

constexpr unsigned number(station_id s) { return static_cast<unsigned>(s); }
constexpr bool is_server_number(station_id s) { return number(s) >= 1 && number(s) <= 999; }

inline constexpr std::size_t max_frame_size = 4096;  // header and CR included (11.3.1)

struct frame {
    station_id station{};
    std::uint8_t number{};  // consecutive, 0 follows 255; a response repeats that of its command
    std::string text{};     // with its mark; data alone in later frames of a response
    bool more = false;      // `&` behind the CRC
    check checked = check::good;
    bool operator==(const frame&) const = default;
};

// What surrounds the text, in characters: header, station, frame number, CRC, CR.
inline constexpr std::size_t frame_overhead = 12;

// CRC-16-CCITT over all characters from the header to the last of the text (11.3.1): polynomial 1021H, start FFFFH,
// input and output reflected (CRC-16/MCRF4XX). The manual names the polynomial only; the rest is from one recorded
// frame.
std::uint16_t crc16(std::string_view characters);

buffer encode_frame(const frame& f);  // with CR

// From the header to the last character in front of CR. Fails with too_short or bad_header; a wrong CRC is no failure.
result<frame> parse_frame(std::string_view characters);

}  // namespace plcgw::mewtocol7
