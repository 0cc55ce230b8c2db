#include "bridge/messages/field.hpp"

#include <bit>

namespace plcgw::messages {
namespace {

byte_order order_of(const field& f) { return f.order == word_order::low_first ? byte_order::cdab : byte_order::abcd; }

std::optional<field_fault> store_whole(const field& f, const decimal& number, words into)
{
    const whole_range range = range_of(f.type);
    const auto value = magnitude(number, f.decimals);
    if (!value)
        return field_fault::out_of_range;
    const bool negative = number.negative && *value != 0;
    if (negative && range.least == 0)
        return field_fault::negative;
    if (*value > (negative ? range.least : range.most))
        return field_fault::out_of_range;
    put_bits(is_bcd(f.type) ? to_bcd(*value) : negative ? 0 - *value : *value, order_of(f), into);
    return std::nullopt;
}

template <class Bits, class Float>
std::optional<field_fault> store_float(std::optional<Float> number, byte_order order, words into)
{
    if (!number)
        return field_fault::out_of_range;
    put_bits(std::bit_cast<Bits>(*number), order, into);
    return std::nullopt;
}

}  // namespace

std::size_t registers_of(const field& f) { return plcgw::registers_of(f.type, f.characters); }

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
    case value_type::float32: return store_float<std::uint32_t>(to_float(value.number, f.decimals), order_of(f), into);
    case value_type::float64: return store_float<std::uint64_t>(to_double(value.number, f.decimals), order_of(f), into);
    default: return store_whole(f, value.number, into);
    }
}

}  // namespace plcgw::messages
