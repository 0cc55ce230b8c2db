// Which command reads, writes or fills which area of words, and with how many digits. FP7 serial communication manual
// 7.2.1, FP programming manual 40.11.
#pragma once

#include "protocols/mewtocol/types.hpp"

namespace plcgw::mewtocol {

struct word_area_row {
    word_area area;
    std::string_view name;  // in a program
    std::string_view read;  // command, "" = none
    std::string_view write;
    std::string_view fill;
    std::string_view letter;  // in front of the numbers of these commands
    unsigned digits;          // decimal digits of the first and of the last number; 0: index registers have none
    std::string_view item;    // in front of a number that MD registers, "" = cannot be
    unsigned item_digits;
};

// clang-format off
inline constexpr word_area_row word_area_table[] = {
    {word_area::wx,     "WX",  "RCC", "",    "",   "X",  4, "WX", 4},
    {word_area::wy,     "WY",  "RCC", "WCC", "SC", "Y",  4, "WY", 4},
    {word_area::wr,     "WR",  "RCC", "WCC", "SC", "R",  4, "WR", 4},
    {word_area::wl,     "WL",  "RCC", "WCC", "SC", "L",  4, "WL", 4},
    {word_area::dt,     "DT",  "RD",  "WD",  "SD", "D",  5, "D",  5},
    {word_area::ld,     "LD",  "RD",  "WD",  "SD", "L",  5, "L",  5},
    {word_area::fl,     "FL",  "RD",  "WD",  "SD", "F",  5, "F",  5},
    {word_area::sv,     "SV",  "RS",  "WS",  "",   "",   4, "S",  5},
    {word_area::ev,     "EV",  "RK",  "WK",  "",   "",   4, "K",  5},
    {word_area::ix,     "IX",  "RD",  "WD",  "",   "IX", 0, "",   0},
    {word_area::iy,     "IY",  "RD",  "WD",  "",   "IY", 0, "",   0},
    {word_area::id,     "ID",  "RD",  "WD",  "",   "ID", 0, "",   0},
    {word_area::system, "SYS", "RR",  "WR",  "",   "0",  3, "",   0},
};
// clang-format on

constexpr const word_area_row& row_of(word_area a) { return word_area_table[static_cast<std::size_t>(a)]; }

constexpr std::uint32_t highest_number(unsigned digits)
{
    std::uint32_t n = 1;
    for (; digits > 0; --digits)
        n *= 10;
    return n - 1;
}

// What stands for the numbers of an index register.
inline constexpr std::string_view index_zeros = "000000000";
constexpr std::uint32_t index_words(word_area a) { return a == word_area::id ? 2 : 1; }

// Characters of area and numbers in front of the words.
constexpr std::size_t range_size(const word_area_row& row)
{
    return row.letter.size() + (row.digits == 0 ? index_zeros.size() : 2 * std::size_t{row.digits});
}

}  // namespace plcgw::mewtocol
