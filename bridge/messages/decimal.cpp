#include "bridge/messages/decimal.hpp"

#include <array>
#include <charconv>
#include <limits>

namespace plcgw::messages {
namespace {

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

// By way of text: from_chars rounds once and correctly.
template <class Float>
std::optional<Float> nearest(const decimal& value, int shift)
{
    if (value.too_large)
        return std::nullopt;
    std::array<char, 48> text{};
    char* at = text.data();
    char* const end = text.data() + text.size();
    if (value.negative)
        *at++ = '-';
    at = std::to_chars(at, end, value.digits).ptr;
    *at++ = 'e';
    at = std::to_chars(at, end, shift - value.places).ptr;
    Float number{};
    if (std::from_chars(text.data(), at, number).ec != std::errc{})
        return std::nullopt;
    return number;
}

}  // namespace

void decimal::append(unsigned digit)
{
    too_large = too_large || digits > (largest - digit) / 10;
    digits = too_large ? 0 : digits * 10 + digit;
}

std::optional<std::uint64_t> magnitude(const decimal& value, int shift)
{
    if (value.too_large)
        return std::nullopt;
    std::uint64_t whole = value.digits;
    int power = shift - value.places;
    for (; power > 0 && whole != 0; --power) {
        if (whole > largest / 10)
            return std::nullopt;
        whole *= 10;
    }
    // Only the last digit cut off decides, and 5 rounds up: nothing is rounded twice.
    for (; power < -1 && whole != 0; ++power)
        whole /= 10;
    if (power < 0 && whole != 0)
        whole = whole / 10 + (whole % 10 >= 5 ? 1 : 0);
    return whole;
}

std::optional<double> to_double(const decimal& value, int shift) { return nearest<double>(value, shift); }

std::optional<float> to_float(const decimal& value, int shift) { return nearest<float>(value, shift); }

}  // namespace plcgw::messages
