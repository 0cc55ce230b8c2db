// MEWTOCOL-COM on the wire, as a station sees it (FP7 serial communication manual, 11.2). Written for the simulated FP7
// alone: it shares nothing with the gateway, which has to meet it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plcgw::field {

// Exclusive-or of all characters from the header on, as two hexadecimal digits.
std::string block_check(std::string_view text);

// Characters of a frame with this header, from it to CR, both included.
constexpr std::size_t longest_frame(char header) { return header == '<' ? 2048 : 118; }

struct heard_frame {
    std::string text;       // from the header to the last character in front of CR
    bool too_long = false;  // text is only its beginning
};

class frame_collector {
public:
    explicit frame_collector(bool knows_expansion) : knows_expansion_(knows_expansion) {}

    // A frame when this character ends one. What stands in front of a header is noise, and a header begins anew.
    // seconds: of any clock that never goes back; a frame that got no CR for a second is forgotten.
    std::optional<heard_frame> take(char character, double seconds);

private:
    bool is_header(char c) const { return c == '%' || (c == '<' && knows_expansion_); }

    bool knows_expansion_;
    heard_frame now_;  // without text: no header was heard
    double began_ = 0;
};

}  // namespace plcgw::field
