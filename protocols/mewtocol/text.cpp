#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol {
namespace {

constexpr std::string_view digit_characters = "0123456789ABCDEF";

void append_digits(std::string& to, std::uint32_t value, unsigned width, unsigned base)
{
    const std::size_t end = to.size() + width;
    to.resize(end);
    for (std::size_t i = 1; i <= width; ++i, value /= base)
        to[end - i] = digit_characters[value % base];
}

std::optional<std::uint32_t> read_digits(std::string_view digits, unsigned base, std::size_t most)
{
    if (digits.empty() || digits.size() > most)
        return std::nullopt;
    std::uint32_t value = 0;
    for (const char c : digits) {
        const std::size_t digit = digit_characters.find(c);
        if (digit >= base)  // npos too
            return std::nullopt;
        value = value * base + static_cast<std::uint32_t>(digit);
    }
    return value;
}

}  // namespace

std::uint16_t swapped(std::uint16_t word) { return static_cast<std::uint16_t>(word << 8 | word >> 8); }

void append_dec(std::string& to, std::uint32_t value, unsigned width) { append_digits(to, value, width, 10); }
void append_hex(std::string& to, std::uint32_t value, unsigned width) { append_digits(to, value, width, 16); }

void append_words(std::string& to, std::span<const std::uint16_t> words)
{
    for (const std::uint16_t word : words)
        append_hex(to, swapped(word), 4);
}

std::optional<std::uint32_t> read_dec(std::string_view digits) { return read_digits(digits, 10, 9); }
std::optional<std::uint32_t> read_hex(std::string_view digits) { return read_digits(digits, 16, 8); }

std::optional<std::vector<std::uint16_t>> words_in(std::string_view text)
{
    if (text.size() % 4 != 0)
        return std::nullopt;
    std::vector<std::uint16_t> words;
    words.reserve(text.size() / 4);
    for (; !text.empty(); text.remove_prefix(4)) {
        const auto word = read_hex(text.substr(0, 4));
        if (!word)
            return std::nullopt;
        words.push_back(swapped(static_cast<std::uint16_t>(*word)));
    }
    return words;
}

}  // namespace plcgw::mewtocol
