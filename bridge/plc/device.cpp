#include "bridge/plc/device.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace plcgw::plc {
namespace {

struct kind_name {
    device_kind kind;
    std::string_view name;
    int base;  // of the number in the text
};

constexpr std::array<kind_name, 10> names{{
    {device_kind::x, "X", 8},
    {device_kind::y, "Y", 8},
    {device_kind::m, "M", 10},
    {device_kind::s, "S", 10},
    {device_kind::ts, "TS", 10},
    {device_kind::cs, "CS", 10},
    {device_kind::d, "D", 10},
    {device_kind::r, "R", 10},
    {device_kind::tn, "TN", 10},
    {device_kind::cn, "CN", 10},
}};

const kind_name& row(device_kind kind) { return names[static_cast<std::size_t>(kind)]; }

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string_view to_string(device_kind kind) { return row(kind).name; }

std::string to_string(device d)
{
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), d.number, row(d.kind).base).ptr;
    return std::string(row(d.kind).name).append(digits.data(), end);
}

std::optional<device> parse_device(std::string_view text)
{
    const auto letters = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_letter) - text.begin());
    std::string name(text.substr(0, letters));
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const auto known = std::find_if(names.begin(), names.end(), [&](const kind_name& n) { return n.name == name; });
    const std::string_view digits = text.substr(letters);
    if (known == names.end() || digits.empty())
        return std::nullopt;
    device parsed{known->kind, 0};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), parsed.number, known->base);
    if (error != std::errc{} || end != digits.data() + digits.size())
        return std::nullopt;
    return parsed;
}

}  // namespace plcgw::plc
