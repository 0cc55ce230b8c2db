// What commands and responses of MEWTOCOL7-COM have in common: their names, and words in the order of a dialect.
#pragma once

#include "protocols/mewtocol/mewtocol7_message.hpp"
#include "protocols/mewtocol/text.hpp"

#include <algorithm>

namespace plcgw::mewtocol7 {

inline constexpr std::string_view read_name = "00MMRD";
inline constexpr std::string_view write_name = "00MMWT";
inline constexpr std::string_view state_name = "30STRD";
inline constexpr std::string_view state_argument = "00";  // read
inline constexpr std::size_t name_size = 6;

inline std::string_view name_of(const command& c)
{
    constexpr std::string_view names[] = {read_name, write_name, state_name};
    return names[c.index()];
}

inline void append_data(std::string& to, std::span<const std::uint16_t> data, const dialect& d)
{
    if (d.words == byte_order::low_byte_first)
        mewtocol::append_words(to, data);
    else
        for (const std::uint16_t word : data)
            mewtocol::append_hex(to, word, 4);
}

// Nothing for a character that is no digit, and for a part of a word.
inline std::optional<std::vector<std::uint16_t>> read_data(std::string_view text, const dialect& d)
{
    auto data = mewtocol::words_in(text);
    if (data && d.words == byte_order::high_byte_first)
        std::transform(data->begin(), data->end(), data->begin(), mewtocol::swapped);
    return data;
}

}  // namespace plcgw::mewtocol7
