#include "bridge/messages/field.hpp"

#include <algorithm>
#include <bit>

namespace plcgw::messages {
namespace {

struct type_row {
    value_type type;
    std::size_t registers;
    std::uint64_t most;   // largest value; of whole numbers only
    std::uint64_t least;  // smallest value without its sign
};

// clang-format off
constexpr type_row types[] = {
    {value_type::int16,   1, 0x7FFF,       0x8000     },
    {value_type::uint16,  1, 0xFFFF,       0          },
    {value_type::int32,   2, 0x7FFF'FFFF,  0x8000'0000},
    {value_type::uint32,  2, 0xFFFF'FFFF,  0          },
    {value_type::float32, 2, 0,            0          },
    {value_type::float64, 4, 0,            0          },
    {value_type::bcd16,   1, 9999,         0          },
    {value_type::bcd32,   2, 9999'9999,    0          },
};
// clang-format on

const type_row& row_of(value_type type)
{
    return *std::find_if(std::begin(types), std::end(types), [&](const type_row& each) { return each.type == type; });
}

std::uint64_t bcd(std::uint64_t value)
{
    std::uint64_t digits = 0;
    for (unsigned shift = 0; value != 0; value /= 10, shift += 4)
        digits |= value % 10 << shift;
    return digits;
}

void put(std::uint64_t bits, word_order order, words into)
{
    for (std::size_t i = 0; i < into.size(); ++i)
        into[order == word_order::low_first ? i : into.size() - 1 - i] = static_cast<std::uint16_t>(bits >> (16 * i));
}

std::optional<field_fault> store_whole(const field& f, const decimal& number, words into)
{
    const type_row& type = row_of(f.type);
    const auto value = magnitude(number, f.decimals);
    if (!value)
        return field_fault::out_of_range;
    const bool negative = number.negative && *value != 0;
    if (negative && type.least == 0)
        return field_fault::negative;
    if (*value > (negative ? type.least : type.most))
        return field_fault::out_of_range;
    const bool is_bcd = f.type == value_type::bcd16 || f.type == value_type::bcd32;
    put(is_bcd ? bcd(*value) : negative ? 0 - *value : *value, f.order, into);
    return std::nullopt;
}

template <class Bits, class Float>
std::optional<field_fault> store_float(std::optional<Float> number, word_order order, words into)
{
    if (!number)
        return field_fault::out_of_range;
    put(std::bit_cast<Bits>(*number), order, into);
    return std::nullopt;
}

}  // namespace

std::size_t registers_of(const field& f)
{
    return f.type == value_type::text ? (f.characters + 1) / 2 : row_of(f.type).registers;
}

std::string_view to_string(field_fault why)
{
    switch (why) {
    case field_fault::out_of_range: return "does not fit the type";
    case field_fault::negative: return "is negative, the type has no sign";
    case field_fault::too_long: return "is longer than its registers";
    }
    return "";
}

std::optional<field_fault> store(const field& f, const capture& value, words into)
{
    switch (f.type) {
    case value_type::text:
        if (value.text.size() > f.characters)
            return field_fault::too_long;
        pack({reinterpret_cast<const std::uint8_t*>(value.text.data()), value.text.size()}, into);
        return std::nullopt;
    case value_type::float32: return store_float<std::uint32_t>(to_float(value.number, f.decimals), f.order, into);
    case value_type::float64: return store_float<std::uint64_t>(to_double(value.number, f.decimals), f.order, into);
    default: return store_whole(f, value.number, into);
    }
}

}  // namespace plcgw::messages
