// What stands in a station, by the names that its programs use: DT100, WR3, SV5, R1F (word 1, bit F), T12.
#pragma once

#include "protocols/mewtocol/areas.hpp"

#include <variant>

namespace plcgw::mewtocol {

struct word_device {
    word_area area{};
    std::uint32_t number{};
    bool operator==(const word_device&) const = default;
};

using device = std::variant<contact, word_device>;

constexpr bool is_contact(const device& d) { return std::holds_alternative<contact>(d); }

// In capitals. Contacts X, Y, R, L: a decimal word, left out when 0, and one hexadecimal digit for the bit, so that R12
// is bit 2 of word 1. Words: an area of areas.hpp and a decimal number; IX, IY and ID stand without one. Nothing when
// the text is no such name, or its number fits into no field.
std::optional<device> parse_device(std::string_view text);

std::string to_string(const device& d);
std::string_view area_name(const device& d);  // "DT", "R"
std::uint32_t number(const device& d);        // of contacts X, Y, R, L the point: R1F is 31

// The area whose words hold these contacts; none for T and C.
std::optional<word_area> words_of(contact_area a);

}  // namespace plcgw::mewtocol
