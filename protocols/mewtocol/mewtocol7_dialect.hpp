// What no public source settles about MEWTOCOL7-COM, in one place. The FP7 serial communication manual (7.2.2, 11.3)
// names the commands MMRD and MMWT and prints one frame, `>@EEE00#00MMRDD001G0DT0000000001000****`; their fields are
// not published. These are the best-supported readings of that frame and of the manual's limits; a configuration may
// set others when a real FP7 says so.
#pragma once

#include "protocols/mewtocol/types.hpp"

#include <vector>

namespace plcgw::mewtocol7 {

using mewtocol::word_area;

enum class number_base : std::uint8_t { decimal = 10, hexadecimal = 16 };
enum class byte_order : std::uint8_t { low_byte_first, high_byte_first };

struct device_name {
    word_area area{};
    std::string name;
    bool operator==(const device_name&) const = default;
};

struct dialect {
    std::string item = "D001";    // in front of the device: probably "data, one item"
    std::string scope = "G0";     // then: probably "global", in contrast to a device of one program block
    unsigned address_digits = 8;  // the printed frame has 13 digits for address and count together; 1 to 8 each
    unsigned count_digits = 5;
    number_base base = number_base::decimal;        // of both
    byte_order words = byte_order::low_byte_first;  // as in MEWTOCOL-COM
    std::string before_words;                       // MMRD response: between the command's name and the words
    std::string before_error;                       // error response: between `!` and the two digits
    std::string before_piece;                       // second and later frames of a response: in front of the data
    std::vector<device_name> devices{{word_area::dt, "DT"}, {word_area::ld, "LD"}, {word_area::wx, "WX"},
                                     {word_area::wy, "WY"}, {word_area::wr, "WR"}, {word_area::wl, "WL"}};
    bool operator==(const dialect&) const = default;
};

}  // namespace plcgw::mewtocol7
