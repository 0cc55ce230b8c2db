#include "tests/field/fp7_commands.hpp"

#include <algorithm>
#include <span>

namespace plcgw::field {

namespace {

// clang-format off
constexpr refusal wrong_format{"41"};   // too short, too long, left over
constexpr refusal unknown{"42"};
constexpr refusal wrong_area{"60"};
constexpr refusal wrong_data{"61"};     // digits, ranges, numbers beyond the area
// clang-format on

constexpr std::string_view hex_digits = "0123456789ABCDEF";

std::size_t number(std::string_view digits, std::size_t base = 10)
{
    std::size_t value = 0;
    for (const char c : digits) {
        const std::size_t digit = hex_digits.find(c);
        if (digit >= base)
            throw wrong_data;
        value = value * base + digit;
    }
    return value;
}

const fp7_area_row& row_of(char letter, std::span<const fp7_area_row> rows, bool write)
{
    const auto row = std::ranges::find(rows, letter, &fp7_area_row::letter);
    if (row == rows.end() || (write && !row->writable))
        throw wrong_area;
    return *row;
}

// --- words: area, first, last, and for writes the words, low byte first ---

struct word_command {
    std::span<const fp7_area_row> rows;
    std::size_t digits;
};
constexpr word_command data_words{fp7_data, 5};
constexpr word_command contact_words{std::span(fp7_contacts).first(4), 4};  // T and C are no words

struct word_range {
    fp7_area area;
    std::size_t first;
    std::size_t count;
};

word_range range(const word_command& command, std::string_view text, bool write)
{
    const std::size_t size = 1 + 2 * command.digits;
    if (text.size() < size || (!write && text.size() > size))
        throw wrong_format;
    const fp7_area_row& row = row_of(text[0], command.rows, write);
    const std::size_t first = number(text.substr(1, command.digits));
    const std::size_t last = number(text.substr(1 + command.digits, command.digits));
    if (last < first)
        throw wrong_data;
    const word_range found{row.area, first, last - first + 1};
    if (write) {
        if (text.size() - size != 4 * found.count)
            throw wrong_format;
        number(text.substr(size), 16);  // only digits
    }
    if (last >= row.words)
        throw wrong_data;
    return found;
}

std::string read_words(fp7_memory& memory, const word_command& command, std::string_view text)
{
    const word_range asked = range(command, text, false);
    std::string words;
    for (std::size_t i = 0; i < asked.count; ++i) {
        const unsigned word = memory.word(asked.area, asked.first + i);
        for (const unsigned shift : {4U, 0U, 12U, 8U})
            words += hex_digits[word >> shift & 0xF];
    }
    return words;
}

std::string write_words(fp7_memory& memory, const word_command& command, std::string_view text)
{
    const word_range told = range(command, text, true);
    const std::string_view words = text.substr(1 + 2 * command.digits);
    for (std::size_t i = 0; i < told.count; ++i) {
        const std::size_t low = number(words.substr(4 * i, 2), 16);
        const std::size_t high = number(words.substr(4 * i + 2, 2), 16);
        memory.word(told.area, told.first + i) = static_cast<std::uint16_t>(high << 8 | low);
    }
    return {};
}

// --- contacts: area, number, and for writes 0 or 1 ---

struct contact {
    fp7_area area;
    std::size_t word;
    unsigned bit;
    bool value;
};

contact parse_contact(const fp7_area_row& row, std::string_view item)
{
    const std::size_t tens = number(item.substr(1, 3));
    const std::size_t digit = number(item.substr(4, 1), row.numbered_in_words ? 16 : 10);
    const std::size_t at = row.numbered_in_words ? tens * 16 + digit : tens * 10 + digit;
    if (at / 16 >= row.words || (item.size() > 5 && item[5] != '0' && item[5] != '1'))
        throw wrong_data;
    return {row.area, at / 16, static_cast<unsigned>(at % 16), item.back() == '1'};
}

std::string contacts(fp7_memory& memory, std::string_view items, std::size_t count, bool write)
{
    const std::size_t size = write ? 6 : 5;
    if (items.size() != count * size)
        throw wrong_format;
    if (count < 1 || count > 8)
        throw wrong_data;
    std::vector<const fp7_area_row*> rows;
    for (std::size_t i = 0; i < count; ++i)
        rows.push_back(&row_of(items[i * size], fp7_contacts, write));
    std::vector<contact> parsed;
    for (std::size_t i = 0; i < count; ++i)
        parsed.push_back(parse_contact(*rows[i], items.substr(i * size, size)));

    std::string read;
    for (const contact& each : parsed) {
        if (write)
            memory.set_contact(each.area, each.word, each.bit, each.value);
        else
            read += memory.contact(each.area, each.word, each.bit) ? '1' : '0';
    }
    return read;
}

std::string several_contacts(fp7_memory& memory, std::string_view text, bool write)
{
    if (text.empty())
        throw wrong_format;
    return contacts(memory, text.substr(1), number(text.substr(0, 1)), write);
}

// Model, version, capacity 0: an FP7. Mode: RUN. No link unit, no error.
std::string status(std::string_view text)
{
    if (!text.empty())
        throw wrong_format;
    return "0000000100000000";
}

using command_function = std::string (*)(fp7_memory&, std::string_view text);
struct command_row {
    std::string_view name;
    command_function run;
};
// clang-format off
constexpr command_row commands[] = {
    {"RD",  [](fp7_memory& m, std::string_view t) { return read_words(m, data_words, t); }},
    {"WD",  [](fp7_memory& m, std::string_view t) { return write_words(m, data_words, t); }},
    {"RCC", [](fp7_memory& m, std::string_view t) { return read_words(m, contact_words, t); }},
    {"WCC", [](fp7_memory& m, std::string_view t) { return write_words(m, contact_words, t); }},
    {"RCS", [](fp7_memory& m, std::string_view t) { return contacts(m, t, 1, false); }},
    {"WCS", [](fp7_memory& m, std::string_view t) { return contacts(m, t, 1, true); }},
    {"RCP", [](fp7_memory& m, std::string_view t) { return several_contacts(m, t, false); }},
    {"WCP", [](fp7_memory& m, std::string_view t) { return several_contacts(m, t, true); }},
    {"RT",  [](fp7_memory&, std::string_view t) { return status(t); }}};
// clang-format on

}  // namespace

std::string execute(fp7_memory& memory, std::string_view text)
{
    for (const command_row& row : commands) {
        if (text.starts_with(row.name))
            return std::string(row.name.substr(0, 2)) + row.run(memory, text.substr(row.name.size()));
    }
    throw unknown;
}

}  // namespace plcgw::field
