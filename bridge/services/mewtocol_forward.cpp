#include "bridge/services/mewtocol_forward.hpp"

#include "bridge/plc/models/fp7.hpp"

#include <algorithm>

namespace plcgw {
namespace {

using modbus::exception_code;
using modbus::table;
using blocks = boost::system::result<std::vector<mewtocol::block>, exception_code>;

struct kind_row {
    plc::device_kind kind;
    mewtocol::device first;
};

// The devices of table 8.2.
const kind_row kind_table[] = {
    {plc::device_kind::x, mewtocol::contact{mewtocol::contact_area::external_input, 0}},
    {plc::device_kind::y, mewtocol::contact{mewtocol::contact_area::external_output, 0}},
    {plc::device_kind::relay, mewtocol::contact{mewtocol::contact_area::internal_relay, 0}},
    {plc::device_kind::d, mewtocol::word_device{mewtocol::word_area::dt, 0}},
    {plc::device_kind::wl, mewtocol::word_device{mewtocol::word_area::wl, 0}},
    {plc::device_kind::ld, mewtocol::word_device{mewtocol::word_area::ld, 0}},
};

struct run {
    mewtocol::device first;
    std::uint32_t count{};
};

mewtocol::device device_at(const plc::map_row& row, std::uint32_t skip)
{
    const auto* const found = std::find_if(std::begin(kind_table), std::end(kind_table),
                                           [&](const kind_row& each) { return each.kind == row.head.kind; });
    mewtocol::device d = found->first;
    const std::uint32_t number = row.head.number + skip;
    if (auto* const contact = std::get_if<mewtocol::contact>(&d))
        contact->number = static_cast<std::uint16_t>(number);
    else
        std::get<mewtocol::word_device>(d).number = number;
    return d;
}

// Empty when any of the numbers leads nowhere.
std::vector<run> runs_of(table in, modbus::address first, std::size_t count)
{
    std::vector<run> found;
    std::uint32_t wanted = modbus::number(first);
    auto left = static_cast<std::uint32_t>(count);
    for (const plc::map_row& row : plc::fp7.standard_map) {
        if (left == 0)
            break;
        if (row.table != in || wanted < row.first || wanted >= row.first + row.count)
            continue;
        const std::uint32_t skip = wanted - row.first;
        const std::uint32_t taken = std::min(left, row.count - skip);
        found.push_back({device_at(row, skip), taken});
        wanted += taken;
        left -= taken;
    }
    return left == 0 ? found : std::vector<run>{};
}

mewtocol::block read_of(const run& r)
{
    if (const auto* const contact = std::get_if<mewtocol::contact>(&r.first))
        return mewtocol::read_run{*contact, r.count};
    const auto& [area, first] = std::get<mewtocol::word_device>(r.first);
    return mewtocol::read_words{area, first, r.count};
}

blocks reads(table in, modbus::address first, std::size_t count)
{
    std::vector<mewtocol::block> found;
    for (const run& each : runs_of(in, first, count))
        found.push_back(read_of(each));
    if (found.empty())
        return exception_code::illegal_data_address;
    return found;
}

blocks coil_writes(modbus::address first, const std::vector<bool>& values)
{
    std::vector<mewtocol::block> found;
    auto next = values.begin();
    for (const run& each : runs_of(table::coils, first, values.size())) {
        const auto end = next + each.count;
        found.push_back(mewtocol::write_run{std::get<mewtocol::contact>(each.first), {next, end}});
        next = end;
    }
    if (found.empty())
        return exception_code::illegal_data_address;
    return found;
}

blocks register_writes(modbus::address first, const std::vector<std::uint16_t>& values)
{
    std::vector<mewtocol::block> found;
    auto next = values.begin();
    for (const run& each : runs_of(table::holding_registers, first, values.size())) {
        const auto end = next + each.count;
        const auto& [area, number] = std::get<mewtocol::word_device>(each.first);
        found.push_back(mewtocol::write_words{area, number, {next, end}});
        next = end;
    }
    if (found.empty())
        return exception_code::illegal_data_address;
    return found;
}

// One overload for each request.
struct translator {
    blocks operator()(const modbus::read_table& r) const { return reads(r.from, r.first, r.count); }
    blocks operator()(const modbus::write_single_coil& r) const { return coil_writes(r.at, {r.on}); }
    blocks operator()(const modbus::write_multiple_coils& r) const { return coil_writes(r.first, r.values); }
    blocks operator()(const modbus::write_single_register& r) const { return register_writes(r.at, {r.value}); }
    blocks operator()(const modbus::write_multiple_registers& r) const { return register_writes(r.first, r.values); }

    // The write comes first (V1.1b3 section 6.17).
    blocks operator()(const modbus::read_write_multiple_registers& r) const
    {
        blocks all = register_writes(r.write_first, r.values);
        const blocks then = reads(table::holding_registers, r.read_first, r.read_count);
        if (!all || !then)
            return exception_code::illegal_data_address;
        all->insert(all->end(), then->begin(), then->end());
        return all;
    }

    template <class NoDevices>
    blocks operator()(const NoDevices&) const
    {
        return exception_code::illegal_function;
    }
};

bool is_read(const modbus::request& question)
{
    return std::holds_alternative<modbus::read_table>(question) ||
           std::holds_alternative<modbus::read_write_multiple_registers>(question);
}

}  // namespace

blocks blocks_of(const modbus::request& question) { return std::visit(translator{}, question); }

modbus::response modbus_answer(const modbus::request& question, const std::vector<mewtocol::response>& answers)
{
    if (answers.empty())
        return exception_code::server_device_failure;
    if (const auto* const refused = std::get_if<mewtocol::error_code>(&answers.back()))
        return exception_of(*refused);
    if (!is_read(question))
        return std::holds_alternative<mewtocol::no_response>(answers.back()) ? modbus::response{modbus::no_response{}}
                                                                             : modbus::response{modbus::written{}};
    modbus::bits_read bits;
    modbus::registers_read registers;
    for (const mewtocol::response& each : answers) {
        if (const auto* const some = std::get_if<mewtocol::contacts_read>(&each))
            bits.values.insert(bits.values.end(), some->values.begin(), some->values.end());
        else if (const auto* const words = std::get_if<mewtocol::words_read>(&each))
            registers.values.insert(registers.values.end(), words->values.begin(), words->values.end());
    }
    return bits.values.empty() ? modbus::response{std::move(registers)} : modbus::response{std::move(bits)};
}

modbus::exception_code exception_of(mewtocol::error_code refused)
{
    using mewtocol::error_code;
    switch (refused) {
    case error_code::parameter:
    case error_code::data:
    case error_code::address: return exception_code::illegal_data_address;
    case error_code::procedure:
    case error_code::simultaneous_operation:
    case error_code::busy:
    case error_code::exclusive_control: return exception_code::server_device_busy;
    case error_code::not_supported: return exception_code::illegal_function;
    default: return exception_code::server_device_failure;
    }
}

}  // namespace plcgw
