#include "protocols/mewtocol/command.hpp"

#include "protocols/mewtocol/areas.hpp"
#include "protocols/mewtocol/text.hpp"

#include <algorithm>
#include <iterator>

namespace plcgw::mewtocol {
namespace {

// In the order of command_code.
constexpr std::string_view code_names[] = {"RC", "WC", "RD", "WD", "RS", "WS", "RK", "WK", "MC", "MD",
                                           "MG", "SC", "SD", "RR", "WR", "RM", "RT", "EX", "AB"};

void append_contact(std::string& to, const contact& c)
{
    to.push_back(static_cast<char>(c.area));
    if (is_numbered(c.area)) {
        append_dec(to, c.number, 4);
    }
    else {
        append_dec(to, c.number / 16U, 3);
        append_hex(to, c.number % 16U, 1);
    }
}

void append_value(std::string& to, const contact_value& v)
{
    append_contact(to, v.at);
    to.push_back(v.on ? '1' : '0');
}

void append_range(std::string& to, const word_area_row& row, std::uint32_t first, std::uint32_t count)
{
    to.append(row.letter);
    if (row.digits == 0) {
        to.append(index_zeros);
    }
    else {
        append_dec(to, first, row.digits);
        append_dec(to, first + count - 1, row.digits);
    }
}

// One overload for each command: the whole text.
struct encoder {
    std::string operator()(const read_contact& c) const
    {
        std::string text = "RCS";
        append_contact(text, c.at);
        return text;
    }
    std::string operator()(const read_contacts& c) const
    {
        std::string text = "RCP";
        append_dec(text, static_cast<std::uint32_t>(c.at.size()), 1);
        for (const contact& each : c.at)
            append_contact(text, each);
        return text;
    }
    std::string operator()(const write_contact& c) const
    {
        std::string text = "WCS";
        append_value(text, c.value);
        return text;
    }
    std::string operator()(const write_contacts& c) const
    {
        std::string text = "WCP";
        append_dec(text, static_cast<std::uint32_t>(c.values.size()), 1);
        for (const contact_value& each : c.values)
            append_value(text, each);
        return text;
    }
    std::string operator()(const read_words& c) const
    {
        std::string text(row_of(c.from).read);
        append_range(text, row_of(c.from), c.first, c.count);
        return text;
    }
    std::string operator()(const write_words& c) const
    {
        std::string text(row_of(c.to).write);
        append_range(text, row_of(c.to), c.first, static_cast<std::uint32_t>(c.values.size()));
        append_words(text, c.values);
        return text;
    }
    std::string operator()(const fill_words& c) const
    {
        std::string text(row_of(c.to).fill);
        append_range(text, row_of(c.to), c.first, c.count);
        append_words(text, std::span(&c.value, 1));
        return text;
    }
    std::string operator()(const register_contacts& c) const
    {
        std::string text = "MC";
        for (const contact& each : c.items)
            append_contact(text, each);
        return text;
    }
    std::string operator()(const forget_contacts&) const { return "MCFFFFF"; }
    std::string operator()(const register_data& c) const
    {
        std::string text = "MD";
        for (const data_item& each : c.items) {
            text.append(row_of(each.area).item);
            append_dec(text, each.number, row_of(each.area).item_digits);
        }
        return text;
    }
    std::string operator()(const forget_data&) const { return "MDFFFFFF"; }
    std::string operator()(const monitor&) const { return "MG"; }
    std::string operator()(const change_mode& c) const { return {'R', 'M', static_cast<char>(c.to)}; }
    std::string operator()(const read_status&) const { return "RT"; }
    std::string operator()(const read_extended_status&) const { return "EX00RT00"; }
    std::string operator()(const abort_transfer&) const { return "AB"; }
};

bool fits(const contact& c)
{
    return is_contact_area(static_cast<char>(c.area)) &&
           c.number <= (is_numbered(c.area) ? max_timer_number : max_contact_number);
}

bool fits_writable(const contact_value& v) { return fits(v.at) && is_writable(v.at.area); }

bool fits_range(word_area area, std::uint32_t first, std::size_t count)
{
    const unsigned digits = row_of(area).digits;
    if (digits == 0)
        return first == 0 && count == index_words(area);
    const std::size_t most = std::size_t{highest_number(digits)} + 1;
    return count >= 1 && first < most && count <= most - first;
}

bool fits_item(const data_item& i)
{
    const word_area_row& row = row_of(i.area);
    return !row.item.empty() && i.number <= highest_number(row.item_digits);
}

struct checker {
    bool operator()(const read_contact& c) const { return fits(c.at); }
    bool operator()(const read_contacts& c) const
    {
        return !c.at.empty() && c.at.size() <= max_contacts && std::all_of(c.at.begin(), c.at.end(), fits);
    }
    bool operator()(const write_contact& c) const { return fits_writable(c.value); }
    bool operator()(const write_contacts& c) const
    {
        return !c.values.empty() && c.values.size() <= max_contacts &&
               std::all_of(c.values.begin(), c.values.end(), fits_writable);
    }
    bool operator()(const read_words& c) const { return fits_range(c.from, c.first, c.count); }
    bool operator()(const write_words& c) const
    {
        return !row_of(c.to).write.empty() && fits_range(c.to, c.first, c.values.size());
    }
    bool operator()(const fill_words& c) const
    {
        return !row_of(c.to).fill.empty() && fits_range(c.to, c.first, c.count);
    }
    bool operator()(const register_contacts& c) const
    {
        return !c.items.empty() && std::all_of(c.items.begin(), c.items.end(), fits);
    }
    bool operator()(const register_data& c) const
    {
        return !c.items.empty() && std::all_of(c.items.begin(), c.items.end(), fits_item);
    }
    bool operator()(const change_mode& c) const { return c.to == operating_mode::run || c.to == operating_mode::prog; }
    template <class Bare>
    bool operator()(const Bare&) const
    {
        return true;
    }
};

}  // namespace

std::string_view to_string(word_area a) { return row_of(a).name; }

std::string_view to_string(command_code c) { return code_names[static_cast<std::size_t>(c)]; }

std::optional<command_code> command_code_named(std::string_view two_letters)
{
    const auto* found = std::find(std::begin(code_names), std::end(code_names), two_letters);
    if (found == std::end(code_names))
        return std::nullopt;
    return command_code{static_cast<std::uint8_t>(found - std::begin(code_names))};
}

command_code code_of(const command& c)
{
    // In the order of the variant; the area says which command reads, writes or fills it.
    constexpr std::string_view names[] = {"RC", "RC", "WC", "WC", "",   "",   "",   "MC",
                                          "MC", "MD", "MD", "MG", "RM", "RT", "EX", "AB"};
    static_assert(std::size(names) == std::variant_size_v<command>);
    std::string_view name = names[c.index()];
    if (const auto* read = std::get_if<read_words>(&c))
        name = row_of(read->from).read;
    else if (const auto* write = std::get_if<write_words>(&c))
        name = row_of(write->to).write;
    else if (const auto* fill = std::get_if<fill_words>(&c))
        name = row_of(fill->to).fill;
    return command_code_named(name.substr(0, 2)).value();  // throws when no command does that to the area
}

bool is_expressible(const command& c) { return std::visit(checker{}, c); }

std::string encode_command(const command& c) { return std::visit(encoder{}, c); }

bool is_write(const command& c)
{
    return std::holds_alternative<write_contact>(c) || std::holds_alternative<write_contacts>(c) ||
           std::holds_alternative<write_words>(c) || std::holds_alternative<fill_words>(c) ||
           std::holds_alternative<change_mode>(c);
}

}  // namespace plcgw::mewtocol
