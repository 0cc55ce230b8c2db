// What registers hold, and in which order its bytes stand in them: of points and of the fields of messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace plcgw {

enum class value_type : std::uint8_t {
    boolean,  // one bit
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64,
    bcd16,  // four digits
    bcd32,  // eight
    text,   // two characters in a register
};

// How the bytes of a value stand in its registers, as devices' manuals name it. A is the highest byte of the value, and
// the letters are read in the order of transmission: high byte of the first register, low byte of the first register
// ...
//
//        32 bits                64 bits                            16 bits and text
// abcd   0x1234 0x5678          0x1234 0x5678 0x9ABC 0xDEF0        0x1234   high byte first
// cdab   0x5678 0x1234          0xDEF0 0x9ABC 0x5678 0x1234        0x1234   registers turned round
// badc   0x3412 0x7856          0x3412 0x7856 0xBC9A 0xF0DE        0x3412   bytes of each register turned round
// dcba   0x7856 0x3412          0xF0DE 0xBC9A 0x7856 0x3412        0x3412   both
enum class byte_order : std::uint8_t { abcd, cdab, badc, dcba };

constexpr bool turns_bytes(byte_order o) { return o == byte_order::badc || o == byte_order::dcba; }
constexpr bool turns_registers(byte_order o) { return o == byte_order::cdab || o == byte_order::dcba; }

// Whole numbers and BCD, without scale.
struct whole_range {
    std::uint64_t most;   // largest value
    std::uint64_t least;  // smallest value without its sign; 0: the type has none
};

constexpr bool is_float(value_type t) { return t == value_type::float32 || t == value_type::float64; }
constexpr bool is_bcd(value_type t) { return t == value_type::bcd16 || t == value_type::bcd32; }
constexpr bool is_whole(value_type t) { return t != value_type::text && !is_float(t); }

whole_range range_of(value_type whole);

// Registers that a value takes; of a boolean the one that has the bit.
std::size_t registers_of(value_type t, std::size_t characters);

using const_register_span = std::span<const std::uint16_t>;
using register_span = std::span<std::uint16_t>;

// The lowest bits of a value of up to 64, as many as the registers have, and back.
void put_bits(std::uint64_t bits, byte_order order, register_span into);
std::uint64_t get_bits(byte_order order, const_register_span from);

std::uint64_t to_bcd(std::uint64_t number);
bool has_bcd_digits(std::uint64_t digits);  // no digit above 9
std::uint64_t from_bcd(std::uint64_t digits);

// Characters two by two, the first in the high byte unless the order turns bytes round; the rest becomes 0. They fit.
void put_text(std::span<const std::uint8_t> text, byte_order order, register_span into);

}  // namespace plcgw
