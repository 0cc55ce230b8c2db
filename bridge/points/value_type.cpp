#include "bridge/points/value_type.hpp"

#include <algorithm>

namespace plcgw {
namespace {

struct type_row {
    value_type type;
    std::size_t registers;
    whole_range range;
};

// clang-format off
constexpr type_row types[] = {
    {value_type::boolean, 1, {1,                     0}                    },
    {value_type::int16,   1, {0x7FFF,                0x8000}               },
    {value_type::uint16,  1, {0xFFFF,                0}                    },
    {value_type::int32,   2, {0x7FFF'FFFF,           0x8000'0000}          },
    {value_type::uint32,  2, {0xFFFF'FFFF,           0}                    },
    {value_type::int64,   4, {0x7FFF'FFFF'FFFF'FFFF, 0x8000'0000'0000'0000}},
    {value_type::uint64,  4, {0xFFFF'FFFF'FFFF'FFFF, 0}                    },
    {value_type::float32, 2, {}                                            },
    {value_type::float64, 4, {}                                            },
    {value_type::bcd16,   1, {9999,                  0}                    },
    {value_type::bcd32,   2, {9999'9999,             0}                    },
};
// clang-format on

const type_row& row_of(value_type type)
{
    return *std::find_if(std::begin(types), std::end(types), [&](const type_row& each) { return each.type == type; });
}

std::uint16_t turned(unsigned reg) { return static_cast<std::uint16_t>(reg >> 8 | reg << 8); }

// Where the register with bits 16 n to 16 n + 15 of the value stands.
std::size_t place_of(std::size_t n, byte_order order, std::size_t count)
{
    return turns_registers(order) ? n : count - 1 - n;
}

}  // namespace

whole_range range_of(value_type whole) { return row_of(whole).range; }

std::size_t registers_of(value_type t, std::size_t characters)
{
    return t == value_type::text ? (characters + 1) / 2 : row_of(t).registers;
}

void put_bits(std::uint64_t bits, byte_order order, register_span into)
{
    for (std::size_t n = 0; n < into.size(); ++n) {
        const auto reg = static_cast<std::uint16_t>(bits >> (16 * n));
        into[place_of(n, order, into.size())] = turns_bytes(order) ? turned(reg) : reg;
    }
}

std::uint64_t get_bits(byte_order order, const_register_span from)
{
    std::uint64_t bits = 0;
    for (std::size_t n = 0; n < from.size(); ++n) {
        const std::uint16_t reg = from[place_of(n, order, from.size())];
        bits |= std::uint64_t{turns_bytes(order) ? turned(reg) : reg} << (16 * n);
    }
    return bits;
}

std::uint64_t to_bcd(std::uint64_t number)
{
    std::uint64_t digits = 0;
    for (unsigned shift = 0; number != 0; number /= 10, shift += 4)
        digits |= number % 10 << shift;
    return digits;
}

bool has_bcd_digits(std::uint64_t digits)
{
    for (; digits != 0; digits >>= 4)
        if ((digits & 0xFU) > 9)
            return false;
    return true;
}

std::uint64_t from_bcd(std::uint64_t digits)
{
    std::uint64_t number = 0;
    for (std::uint64_t weight = 1; digits != 0; digits >>= 4, weight *= 10)
        number += weight * (digits & 0xFU);
    return number;
}

void put_text(std::span<const std::uint8_t> text, byte_order order, register_span into)
{
    std::fill(into.begin(), into.end(), std::uint16_t{0});
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool high = (i % 2 == 0) != turns_bytes(order);
        into[i / 2] = static_cast<std::uint16_t>(into[i / 2] | text[i] << (high ? 8 : 0));
    }
}

}  // namespace plcgw
