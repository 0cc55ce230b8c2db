#include "daemon/scan/unit_list.hpp"

#include "daemon/config/fields.hpp"

#include <algorithm>
#include <charconv>

namespace plcgw {
namespace {

std::vector<std::string> parts_of(const std::string& text)
{
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

std::optional<unsigned> number_in(std::string_view text)
{
    unsigned value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

template <class Enum, std::size_t N>
std::string_view name_in(const config::choice<Enum> (&choices)[N], Enum value)
{
    const auto* const found =
        std::find_if(std::begin(choices), std::end(choices), [value](const auto& each) { return each.value == value; });
    return found == std::end(choices) ? std::string_view() : found->name;
}

std::optional<scan_format> parse_format(const std::string& text)
{
    if (text.size() != 3)
        return std::nullopt;
    const std::size_t parity_at = std::string_view("NOE").find(text[1]);
    const bool is_one =
        (text[0] == '7' || text[0] == '8') && parity_at != std::string_view::npos && (text[2] == '1' || text[2] == '2');
    if (!is_one)
        return std::nullopt;
    constexpr parity parities[] = {parity::none, parity::odd, parity::even};
    return scan_format{text[0] == '7' ? 7U : 8U, parities[parity_at], text[2] == '2' ? 2U : 1U};
}

}  // namespace

std::optional<std::vector<unsigned>> parse_numbers(const std::string& text, unsigned least, unsigned most)
{
    std::vector<unsigned> numbers;
    for (const std::string& part : parts_of(text)) {
        const std::size_t dash = std::min(part.find('-'), part.size());
        const auto first = number_in(std::string_view(part).substr(0, dash));
        const auto last = dash == part.size() ? first : number_in(std::string_view(part).substr(dash + 1));
        if (!first || !last || *first < least || *last > most || *first > *last)
            return std::nullopt;
        for (unsigned each = *first; each <= *last; ++each)
            if (std::find(numbers.begin(), numbers.end(), each) == numbers.end())
                numbers.push_back(each);
    }
    return numbers;
}

std::string to_string(const scan_format& f)
{
    const char letter = f.check == parity::none ? 'N' : f.check == parity::odd ? 'O' : 'E';
    return std::to_string(f.data_bits) + letter + std::to_string(f.stop_bits);
}

std::optional<std::vector<scan_format>> parse_formats(const std::string& text)
{
    std::vector<scan_format> formats;
    for (const std::string& part : parts_of(text)) {
        const auto format = parse_format(part);
        if (!format)
            return std::nullopt;
        formats.push_back(*format);
    }
    return formats;
}

std::optional<std::vector<line_protocol>> parse_protocols(const std::string& text)
{
    std::vector<line_protocol> protocols;
    for (const std::string& part : parts_of(text)) {
        const auto* const found = std::find_if(std::begin(config::line_protocols), std::end(config::line_protocols),
                                               [&](const auto& each) { return each.name == part; });
        if (found == std::end(config::line_protocols) || found->value == line_protocol::general_purpose)
            return std::nullopt;
        protocols.push_back(found->value);
    }
    return protocols;
}

std::string_view name_of(line_protocol p) { return name_in(config::line_protocols, p); }
std::string_view name_of(parity p) { return name_in(config::parities, p); }

unsigned highest_unit(line_protocol p)
{
    switch (p) {
    case line_protocol::mewtocol_com: return 99;
    case line_protocol::mewtocol7_com: return 999;
    case line_protocol::modbus_tcp: return 255;
    default: return 247;
    }
}

unsigned lowest_unit(line_protocol p) { return p == line_protocol::modbus_tcp ? 0 : 1; }

}  // namespace plcgw
