#include "protocols/mewtocol/mewtocol7_message.hpp"

#include "protocols/mewtocol/text.hpp"

#include <algorithm>

namespace plcgw::mewtocol7 {
namespace {

using mewtocol::append_dec;
using mewtocol::append_hex;
using mewtocol::append_words;
using mewtocol::read_dec;
using mewtocol::read_hex;
using mewtocol::swapped;

using parsed = boost::system::result<command, error_code>;
using words = std::vector<std::uint16_t>;

constexpr std::string_view read_name = "00MMRD";
constexpr std::string_view write_name = "00MMWT";
constexpr std::string_view state_name = "30STRD";
constexpr std::string_view state_argument = "00";
constexpr std::size_t name_size = 6;

std::string_view name_of(const command& c)
{
    constexpr std::string_view names[] = {read_name, write_name, state_name};
    return names[c.index()];
}

const device_name* device_of(word_area a, const dialect& d)
{
    const auto found =
        std::find_if(d.devices.begin(), d.devices.end(), [&](const device_name& each) { return each.area == a; });
    return found == d.devices.end() ? nullptr : &*found;
}

void append_number(std::string& to, std::uint32_t value, unsigned width, const dialect& d)
{
    d.base == number_base::decimal ? append_dec(to, value, width) : append_hex(to, value, width);
}

std::optional<std::uint32_t> read_number(std::string_view digits, const dialect& d)
{
    return d.base == number_base::decimal ? read_dec(digits) : read_hex(digits);
}

std::uint64_t highest(unsigned digits, const dialect& d)
{
    std::uint64_t n = 1;
    for (; digits > 0; --digits)
        n *= static_cast<unsigned>(d.base);
    return n - 1;
}

void append_data(std::string& to, std::span<const std::uint16_t> data, const dialect& d)
{
    if (d.words == byte_order::low_byte_first)
        append_words(to, data);
    else
        for (const std::uint16_t word : data)
            append_hex(to, word, 4);
}

std::optional<words> read_data(std::string_view text, const dialect& d)
{
    auto data = mewtocol::words_in(text);
    if (data && d.words == byte_order::high_byte_first)
        std::transform(data->begin(), data->end(), data->begin(), swapped);
    return data;
}

void append_block(std::string& to, word_area area, std::uint32_t first, std::size_t count, const dialect& d)
{
    to.append(d.item).append(d.scope).append(device_of(area, d)->name);
    append_number(to, first, d.address_digits, d);
    append_number(to, static_cast<std::uint32_t>(count), d.count_digits, d);
}

struct block {
    word_area area{};
    std::uint32_t first{};
    std::uint32_t count{};
    std::string_view rest;
};

// Item, scope and device, address, count. Checks form, then names, then numbers, as MEWTOCOL-COM does.
boost::system::result<block, error_code> read_block(std::string_view args, const dialect& d)
{
    const std::size_t numbers = d.address_digits + d.count_digits;
    const std::size_t names = d.item.size() + d.scope.size();
    if (args.size() < names + numbers + 1)
        return error_code::format;
    if (!args.starts_with(d.item) || !args.substr(d.item.size()).starts_with(d.scope))
        return error_code::parameter;
    args.remove_prefix(names);
    const auto device = std::find_if(d.devices.begin(), d.devices.end(),
                                     [&](const device_name& each) { return args.starts_with(each.name); });
    if (device == d.devices.end())
        return error_code::parameter;
    args.remove_prefix(device->name.size());
    if (args.size() < numbers)
        return error_code::format;
    const auto first = read_number(args.substr(0, d.address_digits), d);
    const auto count = read_number(args.substr(d.address_digits, d.count_digits), d);
    if (!first || !count || *count == 0)
        return error_code::data;
    return block{device->area, *first, *count, args.substr(numbers)};
}

parsed parse_read(std::string_view args, const dialect& d)
{
    const auto b = read_block(args, d);
    if (!b)
        return b.error();
    if (!b->rest.empty())
        return error_code::format;
    return command{read_words{b->area, b->first, b->count}};
}

parsed parse_write(std::string_view args, const dialect& d)
{
    const auto b = read_block(args, d);
    if (!b)
        return b.error();
    if (b->rest.size() != 4 * std::size_t{b->count})
        return error_code::format;
    auto values = read_data(b->rest, d);
    if (!values)
        return error_code::data;
    return command{write_words{b->area, b->first, std::move(*values)}};
}

bool fits(word_area area, std::uint32_t first, std::size_t count, const dialect& d)
{
    return device_of(area, d) != nullptr && first <= highest(d.address_digits, d) && count >= 1 &&
           count <= highest(d.count_digits, d);
}

// Characters of a MMWT frame without its words.
std::size_t write_overhead(const dialect& d, std::size_t name)
{
    return frame_overhead + 1 + name_size + d.item.size() + d.scope.size() + name + d.address_digits + d.count_digits;
}

void append_state(std::string& text, const state_read& s)
{
    text.append(state_argument);
    append_hex(text, s.series, 2);
    append_hex(text, s.model, 2);
    append_hex(text, s.special_order, 4);
    append_hex(text, s.newest_version, 4);
    append_hex(text, s.communication_version, 4);
    append_hex(text, s.operation_version, 4);
    append_hex(text, s.mode, 2);
    append_hex(text, s.error_flags, 2);
    append_hex(text, s.self_diagnosis, 4);
    append_hex(text, s.card, 2);
    text.append(s.rest);
}

// Digits from `at` on; something else makes the answer unexpected.
std::uint16_t hex_at(std::string_view text, std::size_t at, std::size_t digits, bool& good)
{
    const auto value = read_hex(text.substr(at, digits));
    good = good && value;
    return static_cast<std::uint16_t>(value.value_or(0));
}

result<response> parse_state(std::string_view text)
{
    constexpr std::size_t size = 38;
    if (text.size() != size || !text.starts_with(state_argument))
        return make_error_code(errc::unexpected_answer);
    bool good = true;
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(hex_at(text, at, 2, good)); };
    const auto word = [&](std::size_t at) { return hex_at(text, at, 4, good); };
    state_read s{byte(2),
                 byte(4),
                 word(6),
                 word(10),
                 word(14),
                 word(18),
                 byte(22),
                 byte(24),
                 word(26),
                 byte(30),
                 std::string(text.substr(32))};
    if (!good)
        return make_error_code(errc::unexpected_answer);
    return response{std::move(s)};
}

}  // namespace

std::size_t max_words_written(const dialect& d)
{
    std::size_t longest = 0;
    for (const device_name& each : d.devices)
        longest = std::max(longest, each.name.size());
    const std::size_t around = write_overhead(d, longest);
    return around >= max_frame_size ? 0 : (max_frame_size - around) / 4;
}

parsed parse_command(std::string_view text, const dialect& d)
{
    if (text.size() < name_size)
        return error_code::format;
    const std::string_view name = text.substr(0, name_size);
    const std::string_view args = text.substr(name_size);
    if (name == read_name)
        return parse_read(args, d);
    if (name == write_name)
        return parse_write(args, d);
    if (name != state_name)
        return error_code::not_supported;
    if (args != state_argument)
        return error_code::format;
    return command{read_status{}};
}

bool is_expressible(const command& c, const dialect& d)
{
    if (const auto* read = std::get_if<read_words>(&c))
        return fits(read->from, read->first, read->count, d);
    if (const auto* write = std::get_if<write_words>(&c))
        return fits(write->to, write->first, write->values.size(), d) && write->values.size() <= max_words_written(d);
    return true;
}

std::string encode_command(const command& c, const dialect& d)
{
    std::string text(name_of(c));
    if (const auto* read = std::get_if<read_words>(&c)) {
        append_block(text, read->from, read->first, read->count, d);
    }
    else if (const auto* write = std::get_if<write_words>(&c)) {
        append_block(text, write->to, write->first, write->values.size(), d);
        append_data(text, write->values, d);
    }
    else {
        text.append(state_argument);
    }
    return text;
}

std::string encode_response(const command& question, const response& answer, const dialect& d)
{
    if (std::holds_alternative<no_response>(answer))
        return {};
    if (const auto* code = std::get_if<error_code>(&answer)) {
        std::string text = "!" + d.before_error;
        append_hex(text, static_cast<std::uint8_t>(*code), 2);
        return text;
    }
    std::string text = "$";
    text.append(name_of(question));
    if (const auto* read = std::get_if<words_read>(&answer)) {
        text.append(d.before_words);
        append_data(text, read->values, d);
    }
    else if (const auto* state = std::get_if<state_read>(&answer)) {
        append_state(text, *state);
    }
    return text;
}

result<response> parse_response(const command& question, std::string_view text, const dialect& d)
{
    const auto unexpected = make_error_code(errc::unexpected_answer);
    if (text.starts_with('!')) {
        const std::string_view behind = text.substr(1);
        if (!behind.starts_with(d.before_error) || behind.size() != d.before_error.size() + 2)
            return unexpected;
        const auto code = read_hex(behind.substr(d.before_error.size()));
        if (!code)
            return unexpected;
        return response{error_code{static_cast<std::uint8_t>(*code)}};
    }
    if (!text.starts_with('$') || text.substr(1, name_size) != name_of(question))
        return unexpected;
    std::string_view data = text.substr(1 + name_size);
    if (std::holds_alternative<read_status>(question))
        return parse_state(data);
    if (std::holds_alternative<write_words>(question))
        return data.empty() ? result<response>{response{executed{}}} : unexpected;
    if (!data.starts_with(d.before_words))
        return unexpected;
    data.remove_prefix(d.before_words.size());
    auto values =
        data.size() == 4 * std::size_t{std::get<read_words>(question).count} ? read_data(data, d) : std::nullopt;
    if (!values)
        return unexpected;
    return response{words_read{std::move(*values)}};
}

std::optional<std::vector<command>> plan_write(const write_words& block, const dialect& d)
{
    const auto count = static_cast<std::uint32_t>(block.values.size());
    const auto most = static_cast<std::uint32_t>(max_words_written(d));
    if (count == 0 || most < 2 || !fits(block.to, block.first, 1, d) || !fits(block.to, block.first + count - 1, 1, d))
        return std::nullopt;
    const std::uint32_t piece = count <= most ? count : most & ~1U;
    std::vector<command> commands;
    for (std::uint32_t done = 0; done < count; done += piece) {
        const auto begin = block.values.begin() + done;
        commands.emplace_back(
            write_words{block.to, block.first + done, {begin, begin + std::min(piece, count - done)}});
    }
    return commands;
}

}  // namespace plcgw::mewtocol7
