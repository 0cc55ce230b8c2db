#include "protocols/mewtocol/mewtocol7_fields.hpp"

namespace plcgw::mewtocol7 {
namespace {

using mewtocol::append_dec;
using mewtocol::append_hex;
using mewtocol::read_dec;
using mewtocol::read_hex;

using parsed = boost::system::result<command, error_code>;

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
