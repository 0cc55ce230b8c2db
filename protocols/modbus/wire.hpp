// Big-endian words and packed bits, as MODBUS puts them into a PDU (V1.1b3 section 4.2).
#pragma once

#include "protocols/bytes.hpp"

#include <vector>

namespace plcgw::modbus {

constexpr std::uint16_t read_word(bytes from, std::size_t at)
{
    return static_cast<std::uint16_t>(from[at] << 8 | from[at + 1]);
}

inline void append_word(buffer& to, std::uint16_t value)
{
    to.push_back(static_cast<std::uint8_t>(value >> 8));
    to.push_back(static_cast<std::uint8_t>(value & 0xFF));
}

constexpr std::size_t packed_size(std::size_t bit_count) { return (bit_count + 7) / 8; }

void append_bits(buffer& to, const std::vector<bool>& bits);   // first bit = least significant of the first byte
std::vector<bool> read_bits(bytes packed, std::size_t count);  // packed holds packed_size(count) bytes at least

void append_words(buffer& to, const std::vector<std::uint16_t>& words);
std::vector<std::uint16_t> read_words(bytes big_endian);

}  // namespace plcgw::modbus
