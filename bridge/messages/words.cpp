#include "bridge/messages/words.hpp"

#include "bridge/points/value_type.hpp"

namespace plcgw::messages {

using general_purpose::ending;

void pack(bytes from, words area)
{
    put_text(from, byte_order::badc, area);  // the first of two in the low byte
}

result<std::size_t> store_message(bytes message, words area)
{
    const std::size_t needed = words_of(message.size());
    if (needed > area.size() || message.size() > general_purpose::max_message_size)
        return make_error_code(errc::overlong);
    area.front() = static_cast<std::uint16_t>(message.size());
    pack(message, area.subspan(1, needed - 1));
    return needed;
}

result<outgoing> message_in(const_words area)
{
    constexpr int most_with_end_code = 4094;
    constexpr int most_without = 4096;
    if (area.empty())
        return make_error_code(errc::bad_count);
    const int count = static_cast<std::int16_t>(area.front());
    if (count == 0 || count > most_with_end_code || count < -most_without)
        return make_error_code(errc::bad_count);
    const auto size = static_cast<std::size_t>(count < 0 ? -count : count);
    if (words_of(size) > area.size())
        return make_error_code(errc::bad_count);

    outgoing message{{}, count < 0 ? ending::without_end_code : ending::with_end_code};
    message.content.reserve(size);
    for (std::size_t i = 0; i < size; ++i)
        message.content.push_back(static_cast<std::uint8_t>(area[1 + i / 2] >> (i % 2 == 0 ? 0 : 8)));
    return message;
}

}  // namespace plcgw::messages
