#include "protocols/mewtocol/frame.hpp"

#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol {
namespace {

constexpr std::size_t station_end = 3;
constexpr std::size_t shortest = 5;  // header, station, BCC

std::optional<station_id> read_station(std::string_view two)
{
    if (two == "EE")
        return station_id::any;
    if (two == "FF")
        return station_id::global;
    const auto number = read_dec(two);
    return number ? std::optional(station_id{static_cast<std::uint8_t>(*number)}) : std::nullopt;
}

check compare(std::string_view covered, std::string_view received)
{
    if (received == "**")
        return check::skipped;
    std::string expected;
    append_hex(expected, bcc(covered), 2);
    return received == expected ? check::good : check::wrong;
}

}  // namespace

std::uint8_t bcc(std::string_view characters)
{
    unsigned value = 0;
    for (const char each : characters)
        value ^= static_cast<std::uint8_t>(each);
    return static_cast<std::uint8_t>(value);
}

buffer encode_frame(const frame& f)
{
    std::string characters{static_cast<char>(f.head)};
    if (f.station == station_id::any || f.station == station_id::global)
        append_hex(characters, number(f.station), 2);
    else
        append_dec(characters, number(f.station), 2);
    characters.append(f.text);
    if (f.checked == check::skipped)
        characters.append("**");
    else
        append_hex(characters, bcc(characters), 2);
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
    f.head = header{static_cast<std::uint8_t>(characters[0])};
    const auto station = read_station(characters.substr(1, 2));
    if ((f.head != header::normal && f.head != header::expansion) || !station)
        return make_error_code(errc::bad_header);
    f.station = *station;
    const std::size_t check_at = characters.size() - 2;
    f.text = characters.substr(station_end, check_at - station_end);
    f.checked = compare(characters.substr(0, check_at), characters.substr(check_at));
    return f;
}

}  // namespace plcgw::mewtocol
