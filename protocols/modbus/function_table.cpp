#include "protocols/modbus/function_table.hpp"

#include "protocols/modbus/wire.hpp"

#include <algorithm>

namespace plcgw::modbus {
namespace {

using shape = length_rule::shape;
using length = std::optional<std::size_t>;

constexpr std::size_t exception_length = 2;
constexpr std::uint8_t exception_bit = 0x80;
constexpr std::uint8_t mei_device_identification = 0x0E;

const function_row* row_of(std::uint8_t code)
{
    const auto row = std::find_if(std::begin(function_table), std::end(function_table),
                                  [&](const function_row& each) { return each.code == code; });
    return row == std::end(function_table) ? nullptr : &*row;
}

// No function has an empty answer or an empty write.
length counted(const length_rule& rule, std::size_t count)
{
    return count == 0 || count % rule.step != 0 ? 0 : rule.size + count;
}

length counted_items(const length_rule& rule, bytes begin)
{
    if (begin.size() <= rule.count_at)
        return std::nullopt;
    const std::uint16_t items = read_word(begin, rule.count_at - 2U);
    const std::size_t count = begin[rule.count_at];
    return count == (rule.step == 2 ? 2U * items : packed_size(items)) ? counted(rule, count) : 0;
}

// Function, MEI type, access, conformity, more, next object, number of objects; each object: id, size, bytes.
length identification_response(const length_rule& rule, bytes begin)
{
    if (begin.size() < rule.size)
        return std::nullopt;
    std::size_t at = rule.size;
    for (unsigned left = begin[rule.size - 1U]; left > 0; --left) {
        if (begin.size() < at + 2)
            return std::nullopt;
        at += 2U + begin[at + 1];
    }
    return at;
}

length length_by(const length_rule& rule, bytes begin)
{
    switch (rule.kind) {
    case shape::unknown: return 0;
    case shape::fixed: return rule.size;
    case shape::counted: return begin.size() <= rule.count_at ? length{} : counted(rule, begin[rule.count_at]);
    case shape::counted_items: return counted_items(rule, begin);
    case shape::counted_word:
        return begin.size() <= rule.count_at + 1U ? length{} : counted(rule, read_word(begin, rule.count_at));
    case shape::identify:
    case shape::identification: break;
    }
    if (begin.size() < 2)
        return std::nullopt;
    if (begin[1] != mei_device_identification)
        return 0;
    return rule.kind == shape::identify ? length{rule.size} : identification_response(rule, begin);
}

}  // namespace

length request_length(bytes begin)
{
    if (begin.empty())
        return std::nullopt;
    const function_row* row = row_of(begin[0]);
    return row == nullptr ? 0 : length_by(row->request, begin);
}

length response_length(bytes begin)
{
    if (begin.empty())
        return std::nullopt;
    if ((begin[0] & exception_bit) != 0)
        return exception_length;
    const function_row* row = row_of(begin[0]);
    return row == nullptr ? 0 : length_by(row->response, begin);
}

}  // namespace plcgw::modbus
