#include "protocols/mewtocol/mewtocol7_frame.hpp"

#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol7 {
namespace {

using namespace mewtocol;  // digits

constexpr std::size_t text_at = 7;
constexpr std::size_t shortest = 11;  // header, station, frame number, CRC

std::optional<station_id> read_station(std::string_view four)
{
    if (four == "@EEE")
        return station_id::any;
    const auto value = read_dec(four.substr(1));
    return value && four[0] == '@' ? std::optional(station_id{static_cast<std::uint16_t>(*value)}) : std::nullopt;
}

check compare(std::string_view covered, std::string_view received)
{
    if (received == "****")
        return check::skipped;
    std::string expected;
    append_hex(expected, mewtocol7::crc16(covered), 4);
    return received == expected ? check::good : check::wrong;
}

}  // namespace

std::uint16_t crc16(std::string_view characters)
{
    constexpr unsigned reflected_polynomial = 0x8408;
    unsigned crc = 0xFFFF;
    for (const char each : characters) {
        crc ^= static_cast<std::uint8_t>(each);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? crc >> 1 ^ reflected_polynomial : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

buffer encode_frame(const frame& f)
{
    std::string characters = ">@";
    if (f.station == station_id::any)
        append_hex(characters, number(f.station), 3);
    else
        append_dec(characters, number(f.station), 3);
    append_hex(characters, f.number, 2);
    characters.append(f.text);
    if (f.checked == check::skipped)
        characters.append("****");
    else
        append_hex(characters, crc16(characters), 4);
    if (f.more)
        characters.push_back('&');
    characters.push_back('\r');
    return {characters.begin(), characters.end()};
}

result<frame> parse_frame(std::string_view characters)
{
    frame f;
    if (!characters.empty() && characters.back() == '&') {
        f.more = true;
        characters.remove_suffix(1);
    }
    if (characters.size() < shortest)
        return make_error_code(errc::too_short);
    const auto station = read_station(characters.substr(1, 4));
    const auto frame_number = read_hex(characters.substr(5, 2));
    if (characters[0] != '>' || !station || !frame_number)
        return make_error_code(errc::bad_header);
    f.station = *station;
    f.number = static_cast<std::uint8_t>(*frame_number);
    const std::size_t check_at = characters.size() - 4;
    f.text = characters.substr(text_at, check_at - text_at);
    f.checked = compare(characters.substr(0, check_at), characters.substr(check_at));
    return f;
}

}  // namespace plcgw::mewtocol7
