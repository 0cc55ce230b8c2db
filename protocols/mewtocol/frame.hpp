// A frame of MEWTOCOL-COM between its header and CR: station, text, BCC. FP7 serial communication manual 11.2, FP0H
// Ethernet manual 11.4.
#pragma once

#include "protocols/errc.hpp"
#include "protocols/mewtocol/types.hpp"

namespace plcgw::mewtocol {

enum class check : std::uint8_t {
    good,
    skipped,  // `**`: the sender wants no check
    wrong,
};

struct frame {
    header head = header::normal;
    station_id station{};
    std::string text{};  // with its mark: `#RDD...`, `$RD...`, `!61`; data alone in the middle of a split message
    bool more = false;   // `&` behind the BCC: not the last frame; with an empty text a request for the next one
    check checked = check::good;
    bool operator==(const frame&) const = default;
};

// What surrounds the text, in characters: header, station, BCC, CR.
inline constexpr std::size_t frame_overhead = 6;

// Exclusive or of all characters from the header to the last of the text.
std::uint8_t bcc(std::string_view characters);

buffer encode_frame(const frame& f);  // with CR; check::wrong is sent as good

// From the header to the last character in front of CR. Fails with too_short, or bad_header when station or header are
// none. A wrong BCC is no failure: the server answers it.
result<frame> parse_frame(std::string_view characters);

}  // namespace plcgw::mewtocol
