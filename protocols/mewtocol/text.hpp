// Numbers in the text of a MEWTOCOL frame: digits of fixed width, upper case, words with the low byte first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plcgw::mewtocol {

void append_dec(std::string& to, std::uint32_t value, unsigned width);  // the lowest `width` digits
void append_hex(std::string& to, std::uint32_t value, unsigned width);
void append_words(std::string& to, std::span<const std::uint16_t> words);  // 1234H is 3412

// Nothing if a character is no such digit, or there is none; at most 9 decimal, 8 hexadecimal digits.
std::optional<std::uint32_t> read_dec(std::string_view digits);
std::optional<std::uint32_t> read_hex(std::string_view digits);

// Four characters for each word. Nothing for a character that is no digit, and for a part of a word.
std::optional<std::vector<std::uint16_t>> words_in(std::string_view text);

std::uint16_t swapped(std::uint16_t word);  // low byte and high byte exchanged

}  // namespace plcgw::mewtocol
