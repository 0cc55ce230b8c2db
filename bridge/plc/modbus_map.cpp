#include "bridge/plc/modbus_map.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using modbus::table;

// One set of D8470-D8485, taken apart (FX3 manual 9.4.1).
struct allocation_set {
    std::uint16_t code;  // 0-5: a bit device in coils, 6-B: the same in holding registers, C-F: word devices
    std::uint16_t blocks;
    std::uint16_t head;  // as it stands in the register
};

constexpr device_kind kinds_by_code[] = {
    device_kind::m, device_kind::s, device_kind::ts, device_kind::cs, device_kind::y, device_kind::x,
    device_kind::m, device_kind::s, device_kind::ts, device_kind::cs, device_kind::y, device_kind::x,
    device_kind::d, device_kind::r, device_kind::tn, device_kind::cn,
};
constexpr std::uint16_t first_register_code = 6;
constexpr std::uint16_t code_d = 0xC;
constexpr std::uint16_t code_r = 0xD;
constexpr std::uint16_t most_blocks = 2048;

// "X and Y addressing should always be completed in octal, i.e. 00, 20, 40" (9.4.1): K20 is X20, the seventeenth input.
// So the decimal digits of the register are the octal number. Nothing when there is an 8 or a 9 among them.
std::optional<device> head_of(const allocation_set& set)
{
    const device_kind kind = kinds_by_code[set.code];
    const std::string digits = std::to_string(set.head);
    return parse_device(std::string(to_string(kind)) + digits);
}

const area* area_of(const model& m, device d)
{
    const auto found = std::find_if(m.areas.begin(), m.areas.end(), [&](const area& a) {
        return a.kind == d.kind && d.number >= a.first && d.number - a.first < a.count;
    });
    return found == m.areas.end() ? nullptr : &*found;
}

// Devices that one block takes: 16 bit devices, 16 registers of D and R, one timer or counter.
std::uint32_t devices_per_block(const allocation_set& set, const area& of)
{
    const bool sixteen = of.bits_per_device == 1 || set.code == code_d || set.code == code_r;
    return sixteen ? 16 : 1;
}

// The manual's checks. Empty when the set is valid.
std::string fault_of(const model& m, const allocation_set& set)
{
    const auto head = head_of(set);
    const area* const of = head ? area_of(m, *head) : nullptr;
    if (set.blocks > most_blocks)
        return "size " + std::to_string(set.blocks) + " is more than 2048 blocks";
    if (of == nullptr)
        return std::string(to_string(kinds_by_code[set.code])) + std::to_string(set.head) +
               " does not exist in this PLC";
    const std::uint32_t step = set.code < first_register_code ? 8 : 16;
    if (of->bits_per_device == 1 && head->number % step != 0)
        return "head " + to_string(*head) + " is no multiple of " + std::to_string(step) + " points";
    const std::uint32_t devices = set.blocks * devices_per_block(set, *of);
    if (devices > of->count - (head->number - of->first)) {
        const device last{head->kind, head->number + devices - 1};
        const device end{head->kind, of->first + of->count - 1};
        return to_string(*head) + "-" + to_string(last) + " exceeds the range of this PLC, which ends at " +
               to_string(end);
    }
    return {};
}

map_row row_of(const model& m, const allocation_set& set, std::uint32_t first)
{
    const device head = *head_of(set);
    const area& of = *area_of(m, head);
    const std::uint32_t bits = set.blocks * devices_per_block(set, of) * of.bits_per_device;
    if (set.code < first_register_code)
        return {table::coils, first, bits, head};
    return {table::holding_registers, first, bits / 16, head};
}

bool is_user_definable(table t) { return t == table::coils || t == table::holding_registers; }

}  // namespace

modbus_map modbus_map::standard(const model& m)
{
    modbus_map map;
    map.rows_.assign(m.standard_map.begin(), m.standard_map.end());
    return map;
}

modbus_map modbus_map::user_defined(const model& m, allocation& sets, std::optional<allocation_fault>& fault)
{
    std::vector<map_row> rows;
    std::uint32_t next[2] = {0, 0};  // the next free coil and holding register
    std::size_t i = 0;
    for (; i < sets.size(); i += 2) {
        const allocation_set set{static_cast<std::uint16_t>(sets[i] >> 12),
                                 static_cast<std::uint16_t>(sets[i] & 0x0FFF), sets[i + 1]};
        if (set.blocks == 0)
            break;  // the list ends here
        if (std::string reason = fault_of(m, set); !reason.empty()) {
            fault = allocation_fault{allocation_first + static_cast<std::uint32_t>(i), std::move(reason)};
            break;
        }
        std::uint32_t& first = next[set.code < first_register_code ? 0 : 1];
        rows.push_back(row_of(m, set, first));
        first += rows.back().count;
    }
    if (fault)
        std::fill(sets.begin() + static_cast<std::ptrdiff_t>(i), sets.end(), std::uint16_t{0});

    modbus_map map = standard(m);
    if (rows.empty())
        return map;
    std::erase_if(map.rows_, [](const map_row& row) { return is_user_definable(row.table); });
    map.rows_.insert(map.rows_.end(), rows.begin(), rows.end());
    return map;
}

std::optional<std::vector<extent>> modbus_map::find(const memory& of, table in, modbus::address first,
                                                    std::size_t count) const
{
    std::vector<extent> found;
    std::size_t wanted = modbus::number(first);
    for (const map_row& row : rows_) {
        if (count == 0)
            break;
        if (row.table != in || wanted < row.first || wanted >= row.first + row.count)
            continue;
        const std::size_t skip = wanted - row.first;
        const std::size_t taken = std::min(count, row.count - skip);
        place at = *of.find(row.head);
        at.bit += skip * (modbus::is_bit_table(in) ? 1 : 16);
        found.push_back({at, taken});
        wanted += taken;
        count -= taken;
    }
    if (count != 0)
        return std::nullopt;
    return found;
}

}  // namespace plcgw::plc
