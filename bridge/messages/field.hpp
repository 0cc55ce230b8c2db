// One part of a message, as the registers of a PLC hold it.
#pragma once

#include "bridge/messages/pattern.hpp"
#include "bridge/messages/words.hpp"
#include "bridge/points/value_type.hpp"

namespace plcgw::messages {

using plcgw::value_type;

// Of values of more than one register. FX, LS and FP keep the low word in the first one.
enum class word_order : std::uint8_t { low_first, high_first };

struct field {
    std::string name;  // of the pattern
    value_type type = value_type::int32;
    // The value is multiplied by 10 to this: 123.4 with 1 is 1234. What an integer cannot hold is rounded, halves away
    // from zero. -9 to 9; not of text.
    int decimals = 0;
    std::size_t characters = 0;  // of text: room in the registers, 1 to 4096; what a value leaves free becomes zero
    word_order order = word_order::low_first;
};

inline constexpr int most_decimals = 9;

// Registers that the field fills.
std::size_t registers_of(const field& f);

enum class field_fault : std::uint8_t {
    out_of_range = 1,  // the number does not fit the type
    negative,          // below zero, where the type has no sign
    too_long,          // more text than there is room
};

std::string_view to_string(field_fault why);

// Fills `into`, registers_of(f) words, or leaves it alone and says why.
std::optional<field_fault> store(const field& f, const capture& value, words into);

}  // namespace plcgw::messages
