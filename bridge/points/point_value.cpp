#include "bridge/points/point.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace plcgw {
namespace {

constexpr double above_int64 = 9223372036854775808.0;  // 2^63

std::int64_t saturated(double number)
{
    if (std::isnan(number))
        return 0;
    if (number >= above_int64)
        return std::numeric_limits<std::int64_t>::max();
    if (number < -above_int64)
        return std::numeric_limits<std::int64_t>::min();
    return static_cast<std::int64_t>(number);
}

bool is_plain(const point_form& f) { return f.scale == 1 && f.offset == 0; }

std::optional<point_value> scaled(const point_form& f, double number)
{
    const double value = number * f.scale + f.offset;
    if (!std::isfinite(value))
        return std::nullopt;
    return real_value(value);
}

std::optional<point_value> decode_whole(const point_form& f, const_register_span from)
{
    std::uint64_t bits = get_bits(f.order, from);
    if (f.type == value_type::boolean)
        return boolean_value(bits != 0);
    if (is_bcd(f.type)) {
        if (!has_bcd_digits(bits))
            return std::nullopt;
        bits = from_bcd(bits);
    }
    const whole_range range = range_of(f.type);
    if (range.least != 0 && bits > range.most) {  // negative: the sign goes through all 64 bits
        const auto number = static_cast<std::int64_t>(bits | ~((range.most << 1) | 1U));
        return is_plain(f) ? integer_value(number) : scaled(f, static_cast<double>(number));
    }
    const bool fits = bits <= std::uint64_t(std::numeric_limits<std::int64_t>::max());
    return is_plain(f) && fits ? integer_value(static_cast<std::int64_t>(bits)) : scaled(f, static_cast<double>(bits));
}

// To the first zero: what follows is left from a longer text.
point_value decode_text(const point_form& f, const_register_span from)
{
    std::string text;
    for (std::size_t i = 0; i < f.characters; ++i) {
        const bool high = (i % 2 == 0) != turns_bytes(f.order);
        const auto character = static_cast<char>(from[i / 2] >> (high ? 8 : 0));
        if (character == '\0')
            break;
        text += character;
    }
    return text_value(std::move(text));
}

}  // namespace

point_value boolean_value(bool on) { return {point_kind::boolean, on ? 1.0 : 0.0, on ? 1 : 0, {}}; }
point_value integer_value(std::int64_t number)
{
    return {point_kind::integer, static_cast<double>(number), number, {}};
}
point_value real_value(double number) { return {point_kind::real, number, saturated(number), {}}; }
point_value text_value(std::string text) { return {point_kind::text, 0, 0, std::move(text)}; }

std::optional<point_value> decode(const point_form& f, const_register_span from)
{
    switch (f.type) {
    case value_type::text: return decode_text(f, from);
    case value_type::float32:
        return scaled(f, std::bit_cast<float>(static_cast<std::uint32_t>(get_bits(f.order, from))));
    case value_type::float64: return scaled(f, std::bit_cast<double>(get_bits(f.order, from)));
    default: return decode_whole(f, from);
    }
}

bool is_inside(const point_limits& l, const point_value& value)
{
    return value.kind == point_kind::text || (!(l.least && value.real < *l.least) && !(l.most && value.real > *l.most));
}

point_value clamped(const point_limits& l, const point_value& value)
{
    if (is_inside(l, value))
        return value;
    const double nearest = l.least && value.real < *l.least ? *l.least : *l.most;
    return value.kind == point_kind::integer && std::trunc(nearest) == nearest ? integer_value(saturated(nearest))
                                                                               : real_value(nearest);
}

}  // namespace plcgw
