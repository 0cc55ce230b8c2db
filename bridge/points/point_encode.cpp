#include "bridge/points/point.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

namespace plcgw {
namespace {

constexpr double above_uint64 = 18446744073709551616.0;  // 2^64

using encoded = point_result<std::vector<std::uint16_t>>;

point_refusal refused(point_fault why, std::string text) { return {why, std::move(text)}; }

std::string printed(double number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

std::string printed(const point_value& value)
{
    return value.kind == point_kind::real ? printed(value.real) : std::to_string(value.integer);
}

// A whole number without its sign.
struct magnitude {
    bool negative = false;
    std::uint64_t number = 0;
};

// Halves away from zero. Nothing beyond 64 bits.
std::optional<magnitude> rounded(double number)
{
    const double nearest = std::round(std::fabs(number));
    if (!(nearest < above_uint64))
        return std::nullopt;
    return magnitude{std::signbit(number) && nearest != 0, static_cast<std::uint64_t>(nearest)};
}

magnitude exact(std::int64_t number)
{
    const auto bits = static_cast<std::uint64_t>(number);
    return {number < 0, number < 0 ? 0 - bits : bits};
}

std::string range_text(const point_form& f)
{
    const whole_range range = range_of(f.type);
    if (f.scale == 1 && f.offset == 0)
        return (range.least == 0 ? std::string("0") : "-" + std::to_string(range.least)) + " to " +
               std::to_string(range.most);
    double low = -static_cast<double>(range.least) * f.scale + f.offset;
    double high = static_cast<double>(range.most) * f.scale + f.offset;
    if (high < low)
        std::swap(low, high);
    return printed(low) + " to " + printed(high);
}

std::vector<std::uint16_t> with_bits(const point_form& f, std::uint64_t bits)
{
    std::vector<std::uint16_t> into(registers_of(f.type, f.characters));
    put_bits(bits, f.order, into);
    return into;
}

std::string limits_text(const point_limits& l)
{
    if (l.least && l.most)
        return printed(*l.least) + " to " + printed(*l.most);
    return l.least ? printed(*l.least) + " and more" : "at most " + printed(*l.most);
}

double value_of(const point_form& f, const magnitude& m)
{
    return (m.negative ? -1.0 : 1.0) * static_cast<double>(m.number) * f.scale + f.offset;
}

// A multiple of 0.1 that misses its limit by rounding of the arithmetic is not beyond it.
bool is_beyond(const point_form& f, double by, double limit)
{
    return by > std::max(std::fabs(f.scale) * 1e-6, std::fabs(limit) * 1e-12);
}

bool is_above(const point_form& f, double made)
{
    return f.limits.most && is_beyond(f, made - *f.limits.most, *f.limits.most);
}
bool is_below(const point_form& f, double made)
{
    return f.limits.least && is_beyond(f, *f.limits.least - made, *f.limits.least);
}

// One number nearer to where the values are larger, or smaller.
magnitude stepped(const point_form& f, const magnitude& from, bool larger_value)
{
    const bool up = larger_value == (f.scale > 0);
    if (from.number == 0)
        return {!up, 1};
    const bool away_from_zero = up != from.negative;
    return {from.negative && from.number != 1, away_from_zero ? from.number + 1 : from.number - 1};
}

// A value inside the limits, or at one of them, whose nearest number is outside: then the next one inside.
std::optional<magnitude> rounded_inside(const point_form& f, double value)
{
    const auto nearest = rounded((value - f.offset) / f.scale);
    if (!nearest)
        return nearest;
    const double made = value_of(f, *nearest);
    if (is_above(f, made))
        return stepped(f, *nearest, false);
    return is_below(f, made) ? stepped(f, *nearest, true) : nearest;
}

encoded encode_whole(const point_form& f, const point_value& value)
{
    const bool plain = f.scale == 1 && f.offset == 0;
    const auto number =
        plain && value.kind != point_kind::real ? std::optional(exact(value.integer)) : rounded_inside(f, value.real);
    if (number && (is_above(f, value_of(f, *number)) || is_below(f, value_of(f, *number))))
        return refused(point_fault::outside,
                       "no number that the registers can hold is inside the limits, " + limits_text(f.limits));
    const whole_range range = range_of(f.type);
    if (!number || number->number > (number->negative ? range.least : range.most))
        return refused(point_fault::out_of_range,
                       printed(value) + " does not fit the registers, which hold " + range_text(f));
    const std::uint64_t bits = number->negative ? 0 - number->number : number->number;
    return with_bits(f, is_bcd(f.type) ? to_bcd(bits) : bits);
}

encoded encode_float(const point_form& f, double value)
{
    const double number = (value - f.offset) / f.scale;
    const double most =
        f.type == value_type::float32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    if (!(std::fabs(number) <= most))
        return refused(point_fault::out_of_range, printed(value) + " does not fit the registers of a float");
    if (f.type == value_type::float32)
        return with_bits(f, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
    return with_bits(f, std::bit_cast<std::uint64_t>(number));
}

encoded encode_text(const point_form& f, const point_value& value)
{
    if (value.kind != point_kind::text)
        return refused(point_fault::wrong_kind, "is a text: give a value of kind text");
    if (value.text.size() > f.characters)
        return refused(point_fault::too_long, "the text has " + std::to_string(value.text.size()) +
                                                  " bytes, there is room for " + std::to_string(f.characters));
    std::vector<std::uint16_t> into(registers_of(f.type, f.characters));
    put_text({reinterpret_cast<const std::uint8_t*>(value.text.data()), value.text.size()}, f.order, into);
    return into;
}

}  // namespace

encoded encode(const point_form& f, const point_value& value)
{
    if (f.type == value_type::text)
        return encode_text(f, value);
    if (value.kind == point_kind::text || value.kind == point_kind::none)
        return refused(point_fault::wrong_kind, "is a number: give a value of kind boolean, integer or real");
    if (!std::isfinite(value.real))
        return refused(point_fault::out_of_range, "NaN and infinities are no values");
    const bool inside = is_inside(f.limits, value);
    if (!inside && f.limits.outside != outside_limits::clamp)
        return refused(point_fault::outside, printed(value) + " is outside the limits, " + limits_text(f.limits));
    const point_value taken = inside ? value : clamped(f.limits, value);
    if (f.type == value_type::boolean && taken.real != 0 && taken.real != 1)
        return refused(point_fault::out_of_range, printed(taken) + " is neither 0 nor 1");
    return is_float(f.type) ? encode_float(f, taken.real) : encode_whole(f, taken);
}

}  // namespace plcgw
