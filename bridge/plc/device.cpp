#include "bridge/plc/device.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace plcgw::plc {
namespace {

bool same_letter(char given, char upper) { return std::toupper(static_cast<unsigned char>(given)) == upper; }

bool begins_with(std::string_view text, const device_name& row)
{
    return text.size() >= row.name.size() && std::equal(row.name.begin(), row.name.end(), text.begin(),
                                                        [](char name, char given) { return same_letter(given, name); });
}

const device_name& row_of(device_kind kind, device_names names)
{
    const auto row = std::find_if(names.begin(), names.end(), [kind](const device_name& n) { return n.kind == kind; });
    if (row == names.end())
        throw std::logic_error("a device of another family");
    return *row;
}

std::optional<std::uint32_t> parse_number(std::string_view digits, int base)
{
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
    if (error != std::errc{} || end != digits.data() + digits.size())
        return std::nullopt;
    return number;
}

std::optional<std::uint32_t> parse_number(std::string_view digits, numbering how)
{
    if (digits.empty())
        return std::nullopt;
    if (how != numbering::word_and_bit)
        return parse_number(digits, how == numbering::octal ? 8 : 10);
    const auto word =
        digits.size() > 1 ? parse_number(digits.substr(0, digits.size() - 1), 10) : std::optional<std::uint32_t>(0);
    const auto bit = parse_number(digits.substr(digits.size() - 1), 16);
    if (!word || !bit || *word > std::numeric_limits<std::uint32_t>::max() / 16)
        return std::nullopt;
    return 16 * *word + *bit;
}

std::string printed(std::uint32_t number, int base)
{
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, base).ptr;
    return {digits.data(), end};
}

std::string print_number(std::uint32_t number, numbering how)
{
    if (how != numbering::word_and_bit)
        return printed(number, how == numbering::octal ? 8 : 10);
    const std::string word = number < 16 ? std::string() : printed(number / 16, 10);
    return word + "0123456789ABCDEF"[number % 16];
}

}  // namespace

std::string_view to_string(device_kind kind, device_names names) { return row_of(kind, names).name; }

std::string to_string(device d, device_names names)
{
    const device_name& row = row_of(d.kind, names);
    return std::string(row.name) + print_number(d.number, row.digits);
}

const device_name* find_name(std::string_view text, device_names names)
{
    const device_name* longest = nullptr;
    for (const device_name& each : names)
        if (begins_with(text, each) && (longest == nullptr || each.name.size() > longest->name.size()))
            longest = &each;
    return longest;
}

// The longest name that leaves a number decides: LD1 is a link register, but LD is contact D of the link relays' word
// 0.
std::optional<device> parse_device(std::string_view text, device_names names)
{
    std::optional<device> parsed;
    std::size_t longest = 0;
    for (const device_name& each : names) {
        if (!begins_with(text, each) || each.name.size() <= longest)
            continue;
        const auto number = parse_number(text.substr(each.name.size()), each.digits);
        if (!number)
            continue;
        longest = each.name.size();
        parsed = device{each.kind, *number};
    }
    return parsed;
}

}  // namespace plcgw::plc
