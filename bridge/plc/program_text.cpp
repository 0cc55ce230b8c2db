#include "bridge/plc/program_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace plcgw::plc {
namespace {

std::vector<std::string> words_of(std::string_view line)
{
    line = line.substr(0, std::min(line.find(';'), line.find("//")));
    std::vector<std::string> words;
    std::string word;
    for (const char c : std::string(line) + ' ') {
        if (std::isspace(static_cast<unsigned char>(c)) == 0 && c != ',') {
            word += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
        else if (!word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    return words;
}

// Whole text as a number, or nothing.
template <class Number>
std::optional<Number> parse_number(std::string_view text, int base)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, base);
    if (error != std::errc{} || stop != end)
        return std::nullopt;
    return value;
}

bool is_digits(const std::string& word)
{
    return std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::vector<program_line> program_lines(std::string_view text)
{
    std::vector<program_line> lines;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        program_line read{number, std::nullopt, words_of(text.substr(0, end))};
        if (!read.words.empty() && is_digits(read.words[0])) {
            read.step = parse_number<std::uint32_t>(read.words[0], 10);
            read.words.erase(read.words.begin());
        }
        if (!read.words.empty())
            lines.push_back(std::move(read));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::optional<std::uint16_t> parse_constant(std::string_view text)
{
    if (text.size() < 2 || (text[0] != 'K' && text[0] != 'H'))
        return std::nullopt;
    const bool decimal = text[0] == 'K';
    const auto value = parse_number<std::int32_t>(text.substr(1), decimal ? 10 : 16);
    if (!value || *value < (decimal ? -32768 : 0) || *value > 65535)
        return std::nullopt;
    return static_cast<std::uint16_t>(*value);
}

}  // namespace plcgw::plc
