#include "protocols/modbus/wire.hpp"

namespace plcgw::modbus {

void append_bits(buffer& to, const std::vector<bool>& bits)
{
    const std::size_t start = to.size();
    to.resize(start + packed_size(bits.size()), 0);
    for (std::size_t i = 0; i < bits.size(); ++i)
        if (bits[i])
            to[start + i / 8] = static_cast<std::uint8_t>(to[start + i / 8] | 1U << (i % 8));
}

std::vector<bool> read_bits(bytes packed, std::size_t count)
{
    std::vector<bool> bits(count);
    for (std::size_t i = 0; i < count; ++i)
        bits[i] = (packed[i / 8] >> (i % 8) & 1U) != 0;
    return bits;
}

void append_words(buffer& to, const std::vector<std::uint16_t>& words)
{
    for (const std::uint16_t word : words)
        append_word(to, word);
}

std::vector<std::uint16_t> read_words(bytes big_endian)
{
    std::vector<std::uint16_t> words(big_endian.size() / 2);
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = read_word(big_endian, 2 * i);
    return words;
}

}  // namespace plcgw::modbus
