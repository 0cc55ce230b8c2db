#include "bridge/messages/notation.hpp"

#include <algorithm>
#include <array>

namespace plcgw::messages {
namespace {

struct control_code {
    std::string_view name;
    std::uint8_t value;
};

// clang-format off
constexpr std::array control_codes = std::to_array<control_code>({  // shown by the first name of a value
    {"NUL", 0x00}, {"SOH", 0x01}, {"STX", 0x02}, {"ETX", 0x03}, {"EOT", 0x04}, {"ENQ", 0x05}, {"ACK", 0x06},
    {"BEL", 0x07}, {"BS",  0x08}, {"HT",  0x09}, {"LF",  0x0A}, {"VT",  0x0B}, {"FF",  0x0C}, {"CR",  0x0D},
    {"SO",  0x0E}, {"SI",  0x0F}, {"DLE", 0x10}, {"DC1", 0x11}, {"DC2", 0x12}, {"DC3", 0x13}, {"DC4", 0x14},
    {"NAK", 0x15}, {"SYN", 0x16}, {"ETB", 0x17}, {"CAN", 0x18}, {"EM",  0x19}, {"SUB", 0x1A}, {"ESC", 0x1B},
    {"FS",  0x1C}, {"GS",  0x1D}, {"RS",  0x1E}, {"US",  0x1F}, {"DEL", 0x7F},
    {"TAB", 0x09}, {"XON", 0x11}, {"XOFF", 0x13},
});

constexpr struct {
    char letter;
    char value;
} escapes[] = {{'\\', '\\'}, {'{', '{'}, {'}', '}'}, {'<', '<'}, {'r', '\r'}, {'n', '\n'}, {'t', '\t'}};
// clang-format on

// "STX" when the text goes on with "<STX>"; nothing when it is an ordinary <.
std::string_view code_name(std::string_view text)
{
    constexpr std::size_t longest = 4;
    std::size_t size = 1;
    while (size < text.size() && ((text[size] >= 'A' && text[size] <= 'Z') || (text[size] >= '0' && text[size] <= '9')))
        ++size;
    const bool named = text.starts_with('<') && size > 2 && size <= longest + 1 && text.substr(size).starts_with('>');
    return named ? text.substr(1, size - 1) : std::string_view{};
}

std::optional<std::uint8_t> hex_digit(char c)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto at = digits.find(c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c);
    return at == digits.npos ? std::nullopt : std::optional(static_cast<std::uint8_t>(at));
}

std::optional<text_mistake> read_escape(std::string_view text, std::size_t& at, buffer& to)
{
    const std::size_t begin = at;
    const std::string_view rest = text.substr(begin + 1);
    if (rest.starts_with('x')) {
        const auto high = rest.size() > 2 ? hex_digit(rest[1]) : std::nullopt;
        const auto low = rest.size() > 2 ? hex_digit(rest[2]) : std::nullopt;
        if (!high || !low)
            return text_mistake{begin + 1, "\\x needs two hexadecimal digits, as \\x05"};
        at = begin + 4;
        to.push_back(static_cast<std::uint8_t>(*high << 4 | *low));
        return std::nullopt;
    }
    for (const auto& each : escapes)
        if (rest.starts_with(each.letter)) {
            at = begin + 2;
            to.push_back(static_cast<std::uint8_t>(each.value));
            return std::nullopt;
        }
    return text_mistake{begin + 1, "a \\ must be followed by one of \\ { } < r n t, or by x and two digits"};
}

void append_printable(std::string& to, std::uint8_t byte)
{
    constexpr const char* digits = "0123456789ABCDEF";
    const auto code = std::find_if(control_codes.begin(), control_codes.end(),
                                   [&](const control_code& each) { return each.value == byte; });
    if (code != control_codes.end())
        to.append("<").append(code->name).append(">");
    else if (byte > 0x7F)
        to.append({'\\', 'x', digits[byte >> 4], digits[byte & 0xF]});
    else
        to.push_back(static_cast<char>(byte));
}

}  // namespace

std::optional<text_mistake> read_character(std::string_view text, std::size_t& at, buffer& to)
{
    if (text[at] == '\\')
        return read_escape(text, at, to);
    const std::string_view name = code_name(text.substr(at));
    if (name.empty()) {
        to.push_back(static_cast<std::uint8_t>(text[at++]));
        return std::nullopt;
    }
    for (const control_code& each : control_codes)
        if (each.name == name) {
            at += name.size() + 2;
            to.push_back(each.value);
            return std::nullopt;
        }
    return text_mistake{at + 1, "<" + std::string(name) + "> is no control code; for the characters write \\<" +
                                    std::string(name) + ">"};
}

parsed<buffer> parse_bytes(std::string_view text)
{
    buffer all;
    for (std::size_t at = 0; at < text.size();)
        if (const auto mistake = read_character(text, at, all))
            return *mistake;
    return all;
}

std::string printable(bytes message)
{
    const std::string_view text(reinterpret_cast<const char*>(message.data()), message.size());
    std::string shown;
    for (std::size_t i = 0; i < message.size(); ++i) {
        if (message[i] == '\\' || !code_name(text.substr(i)).empty())
            shown.push_back('\\');
        append_printable(shown, message[i]);
    }
    return shown;
}

std::string printable(bytes message, std::size_t longest)
{
    if (message.size() <= longest)
        return printable(message);
    return printable(message.first(longest)) + "... (" + std::to_string(message.size()) + " bytes)";
}

}  // namespace plcgw::messages
