#include "bridge/plc/map_query.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace plcgw::plc {
namespace {

using answer = boost::system::result<map_query, std::string>;
using modbus::table;

constexpr std::uint32_t last_number = 0xFFFF;

struct table_name {
    std::string_view name;
    table meant;
};

constexpr table_name table_names[] = {
    {"coil", table::coils},           {"c", table::coils},
    {"di", table::discrete_inputs},   {"discrete", table::discrete_inputs},
    {"ir", table::input_registers},   {"input", table::input_registers},
    {"hr", table::holding_registers}, {"holding", table::holding_registers},
};

constexpr table_name reference_digits[] = {
    {"0", table::coils},
    {"1", table::discrete_inputs},
    {"3", table::input_registers},
    {"4", table::holding_registers},
};

std::string lower(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

bool all_digits(std::string_view text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Decimal, or hexadecimal behind 0x.
std::optional<std::uint32_t> parse_number(std::string_view text)
{
    const int base = text.starts_with("0x") ? 16 : 10;
    if (base == 16)
        text.remove_prefix(2);
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return number;
}

answer parse_table_and_number(std::string_view name, std::string_view digits)
{
    for (const table_name& each : table_names) {
        if (each.name != name)
            continue;
        const auto number = parse_number(digits);
        if (!number || *number > last_number)
            return "\"" + std::string(digits) + "\" is no MODBUS number: 0 to 65535, or 0x0 to 0xFFFF";
        return map_query{map_address{each.meant, *number}};
    }
    return "\"" + std::string(name) + "\" is no table: coil, di, ir or hr";
}

answer parse_reference(std::string_view text)
{
    for (const table_name& each : reference_digits) {
        if (!text.starts_with(each.name))
            continue;
        const std::uint32_t number = *parse_number(text.substr(1));
        if (number == 0 || number > last_number + 1)
            return std::string(text) + " is no reference: they are counted from 1 to 65536, " + std::string(each.name) +
                   (text.size() == 5 ? "0001" : "00001") + " is the first of this table";
        return map_query{map_address{each.meant, number - 1}};
    }
    return std::string(text) + " is no reference: those of coils begin with 0, of discrete inputs with 1, of input "
                               "registers with 3, of holding registers with 4";
}

// LS writes T and C for contacts and values alike.
std::vector<device> parse_devices(std::string_view text, const model& m)
{
    if (const auto one = parse_device(text, m.names))
        return {*one};
    std::vector<device> both;
    if (text.size() < 2 || (text[0] != 't' && text[0] != 'c'))
        return both;
    for (const char* kind : {"s", "n"})
        if (const auto each =
                parse_device(std::string(text.substr(0, 1)) + kind + std::string(text.substr(1)), m.names))
            both.push_back(*each);
    return both;
}

std::string wrong_device(const std::string& text, const model& m)
{
    const device_name* const row = find_name(text, m.names);
    const std::string name(row == nullptr ? "" : row->name);
    if (row != nullptr && row->digits == numbering::octal && all_digits(std::string_view(text).substr(name.size())))
        return name + " is counted in octal: no digits 8 and 9";
    if (row != nullptr && row->digits == numbering::word_and_bit)
        return name + " is numbered by a decimal word and one hexadecimal digit for the bit: " + name + "1F";
    return "expected a device such as " + std::string(m.examples) +
           ", a table with a number (hr:0, coil:0x1E00) or a reference (40001, 400001)";
}

}  // namespace

answer parse_map_query(std::string_view given, const model& m)
{
    const std::string text = lower(given);
    const std::string quoted = "\"" + std::string(given) + "\": ";
    if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
        const std::string_view whole = text;
        const answer found = parse_table_and_number(whole.substr(0, colon), whole.substr(colon + 1));
        return found ? found : answer(quoted + found.error());
    }
    if (all_digits(text)) {
        if (text.size() == 5 || text.size() == 6)
            return parse_reference(text);
        return quoted + "which table? Write hr:" + text + ", ir:, coil: or di:, or a reference of 5 or 6 digits";
    }
    std::vector<device> devices = parse_devices(text, m);
    if (devices.empty())
        return quoted + wrong_device(text, m);
    return map_query{std::move(devices)};
}

}  // namespace plcgw::plc
