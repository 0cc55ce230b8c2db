// The checks of one command come in this order, the first that fails decides: form, areas, numbers, range, length of
// the data, digits of the data.
#include "protocols/mewtocol/areas.hpp"
#include "protocols/mewtocol/command.hpp"
#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol {
namespace {

using parsed = boost::system::result<command, error_code>;

constexpr std::size_t contact_size = 5;  // letter, number
constexpr std::size_t data_item_size = 6;

// Three decimal digits and a hexadecimal one, or four decimal.
std::optional<contact> read_contact_number(std::string_view text)
{
    const contact_area area{text[0]};
    const auto word = read_dec(text.substr(1, is_numbered(area) ? 4 : 3));
    if (is_numbered(area))
        return word ? std::optional(contact{area, static_cast<std::uint16_t>(*word)}) : std::nullopt;
    const auto bit = read_hex(text.substr(4, 1));
    if (!word || !bit)
        return std::nullopt;
    return contact{area, static_cast<std::uint16_t>(16 * *word + *bit)};
}

using area_check = bool (*)(char letter);

bool is_writable_letter(char letter) { return is_contact_area(letter) && is_writable(contact_area{letter}); }

bool all_areas_fit(std::string_view items, std::size_t item_size, area_check fits)
{
    for (std::size_t i = 0; i < items.size(); i += item_size)
        if (!fits(items[i]))
            return false;
    return true;
}

boost::system::result<std::vector<contact>, error_code> read_contact_list(std::string_view items)
{
    if (!all_areas_fit(items, contact_size, is_contact_area))
        return error_code::parameter;
    std::vector<contact> contacts;
    for (; !items.empty(); items.remove_prefix(contact_size)) {
        const auto one = read_contact_number(items.substr(0, contact_size));
        if (!one)
            return error_code::data;
        contacts.push_back(*one);
    }
    return contacts;
}

boost::system::result<std::vector<contact_value>, error_code> read_value_list(std::string_view items)
{
    if (!all_areas_fit(items, contact_size + 1, is_writable_letter))
        return error_code::parameter;
    std::vector<contact_value> values;
    for (; !items.empty(); items.remove_prefix(contact_size + 1)) {
        const auto one = read_contact_number(items.substr(0, contact_size));
        const char value = items[contact_size];
        if (!one || (value != '0' && value != '1'))
            return error_code::data;
        values.push_back({*one, value == '1'});
    }
    return values;
}

// The items behind the count of RCP and WCP.
boost::system::result<std::string_view, error_code> counted_items(std::string_view args, std::size_t item_size)
{
    if (args.empty())
        return error_code::format;
    const auto count = read_dec(args.substr(0, 1));
    if (!count)
        return error_code::data;
    args.remove_prefix(1);
    if (args.size() != *count * item_size)
        return error_code::format;
    if (*count < 1 || *count > max_contacts)
        return error_code::data;
    return args;
}

parsed parse_read_contacts(std::string_view how, std::string_view args)
{
    if (how == "RCP") {
        const auto items = counted_items(args, contact_size);
        if (!items)
            return items.error();
        auto contacts = read_contact_list(*items);
        if (!contacts)
            return contacts.error();
        return command{read_contacts{std::move(*contacts)}};
    }
    if (args.size() != contact_size)
        return error_code::format;
    const auto contacts = read_contact_list(args);
    if (!contacts)
        return contacts.error();
    return command{read_contact{contacts->front()}};
}

parsed parse_write_contacts(std::string_view how, std::string_view args)
{
    if (how == "WCP") {
        const auto items = counted_items(args, contact_size + 1);
        if (!items)
            return items.error();
        auto values = read_value_list(*items);
        if (!values)
            return values.error();
        return command{write_contacts{std::move(*values)}};
    }
    if (args.size() != contact_size + 1)
        return error_code::format;
    const auto values = read_value_list(args);
    if (!values)
        return values.error();
    return command{write_contact{values->front()}};
}

struct range {
    word_area area{};
    std::uint32_t first{};
    std::uint32_t count{};
    std::string_view rest;  // behind the numbers
};

using name_of_row = std::string_view word_area_row::*;

// Area, first and last of a command on words. `exact`: nothing may follow.
boost::system::result<range, error_code> read_range(std::string_view name, name_of_row column, std::string_view args,
                                                    bool exact)
{
    const word_area_row* of = nullptr;   // the area, if the letter is right
    const word_area_row* any = nullptr;  // some area of this command: the sizes are the same
    for (const word_area_row& row : word_area_table) {
        if (row.*column != name)
            continue;
        any = &row;
        if (of == nullptr && args.starts_with(row.letter))
            of = &row;
    }
    const std::size_t size = range_size(*any);
    if (args.size() < size || (exact && args.size() != size))
        return error_code::format;
    if (of == nullptr)
        return error_code::parameter;
    const std::string_view numbers = args.substr(of->letter.size(), size - of->letter.size());
    const std::string_view rest = args.substr(size);
    if (of->digits == 0) {
        if (numbers != index_zeros)
            return error_code::data;
        return range{of->area, 0, index_words(of->area), rest};
    }
    const auto first = read_dec(numbers.substr(0, of->digits));
    const auto last = read_dec(numbers.substr(of->digits));
    if (!first || !last || *last < *first)
        return error_code::data;
    return range{of->area, *first, *last - *first + 1, rest};
}

parsed parse_read_words(std::string_view name, std::string_view args)
{
    const auto from = read_range(name, &word_area_row::read, args, true);
    if (!from)
        return from.error();
    return command{read_words{from->area, from->first, from->count}};
}

parsed parse_write_words(std::string_view name, std::string_view args)
{
    const auto to = read_range(name, &word_area_row::write, args, false);
    if (!to)
        return to.error();
    if (to->rest.size() != 4 * std::size_t{to->count})
        return error_code::format;
    auto values = words_in(to->rest);
    if (!values)
        return error_code::data;
    return command{write_words{to->area, to->first, std::move(*values)}};
}

parsed parse_fill_words(std::string_view name, std::string_view args)
{
    const auto to = read_range(name, &word_area_row::fill, args, false);
    if (!to)
        return to.error();
    if (to->rest.size() != 4)
        return error_code::format;
    const auto value = words_in(to->rest);
    if (!value)
        return error_code::data;
    return command{fill_words{to->area, to->first, to->count, value->front()}};
}

parsed parse_register_contacts(std::string_view args)
{
    if (args == "FFFFF")
        return command{forget_contacts{}};
    if (args.empty() || args.size() % contact_size != 0)
        return error_code::format;
    auto items = read_contact_list(args);
    if (!items)
        return items.error();
    return command{register_contacts{std::move(*items)}};
}

const word_area_row* row_of_item(std::string_view item)
{
    for (const word_area_row& row : word_area_table)
        if (!row.item.empty() && item.starts_with(row.item))
            return &row;
    return nullptr;
}

parsed parse_register_data(std::string_view args)
{
    if (args == "FFFFFF")
        return command{forget_data{}};
    if (args.empty() || args.size() % data_item_size != 0)
        return error_code::format;
    for (std::size_t i = 0; i < args.size(); i += data_item_size)
        if (row_of_item(args.substr(i, data_item_size)) == nullptr)
            return error_code::parameter;
    register_data r;
    for (; !args.empty(); args.remove_prefix(data_item_size)) {
        const word_area_row* row = row_of_item(args);
        const auto number = read_dec(args.substr(row->item.size(), row->item_digits));
        if (!number)
            return error_code::data;
        r.items.push_back({row->area, *number});
    }
    return command{std::move(r)};
}

parsed parse_change_mode(std::string_view args)
{
    if (args.size() != 1)
        return error_code::format;
    if (args != "R" && args != "P")
        return error_code::parameter;
    return command{change_mode{operating_mode{args[0]}}};
}

template <class Command>
parsed parse_bare(std::string_view args, std::string_view expected = {})
{
    if (args != expected)
        return error_code::format;
    return command{Command{}};
}

}  // namespace

parsed parse_command(std::string_view text, const command_set& offered)
{
    if (text.size() < 2)
        return error_code::format;
    const auto code = command_code_named(text.substr(0, 2));
    if (!code || !offered.contains(*code))
        return error_code::not_supported;
    const std::string_view name = text.substr(0, 2);
    const std::string_view args = text.substr(2);
    switch (*code) {
    case command_code::RC:
    case command_code::WC: {
        if (args.empty())
            return error_code::format;
        const std::string_view how = text.substr(0, 3);
        if (args[0] != 'S' && args[0] != 'P' && args[0] != 'C')
            return error_code::not_supported;
        if (*code == command_code::RC)
            return args[0] == 'C' ? parse_read_words(how, args.substr(1)) : parse_read_contacts(how, args.substr(1));
        return args[0] == 'C' ? parse_write_words(how, args.substr(1)) : parse_write_contacts(how, args.substr(1));
    }
    case command_code::RD:
    case command_code::RS:
    case command_code::RK:
    case command_code::RR: return parse_read_words(name, args);
    case command_code::WD:
    case command_code::WS:
    case command_code::WK:
    case command_code::WR: return parse_write_words(name, args);
    case command_code::SC:
    case command_code::SD: return parse_fill_words(name, args);
    case command_code::MC: return parse_register_contacts(args);
    case command_code::MD: return parse_register_data(args);
    case command_code::MG: return parse_bare<monitor>(args);
    case command_code::RM: return parse_change_mode(args);
    case command_code::RT: return parse_bare<read_status>(args);
    case command_code::EX: return parse_bare<read_extended_status>(args, "00RT00");
    case command_code::AB: return parse_bare<abort_transfer>(args);
    }
    return error_code::not_supported;
}

}  // namespace plcgw::mewtocol
