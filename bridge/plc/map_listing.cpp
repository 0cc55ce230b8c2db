#include "bridge/plc/map_listing.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

const area* area_of(const model& m, device d)
{
    const auto found =
        std::find_if(m.areas.begin(), m.areas.end(), [d](const area& a) { return first_bit(a, d).has_value(); });
    return found == m.areas.end() ? nullptr : &*found;
}

// A run of bits in an area's image: what a row, or one number of it, leads to.
struct run {
    const area* of;
    device_kind as;  // the area's bits, or its words
    std::size_t first;
    std::size_t count;
};

std::size_t step_of(const map_row& row) { return modbus::is_bit_table(row.table) ? 1 : 16; }

run run_of(const model& m, const map_row& row)
{
    const area* const of = area_of(m, row.head);
    return {of, row.head.kind, *first_bit(*of, row.head), row.count * step_of(row)};
}

map_target target_of_run(const run& r)
{
    const std::size_t per_device = bits_of(*r.of, r.as);
    const std::size_t bits = std::size_t{r.of->count} * r.of->bits_per_device;
    const std::size_t begin = std::max(r.first / per_device, std::size_t{r.of->absent});
    const std::size_t end = std::min((r.first + r.count - 1) / per_device + 1, bits / per_device);
    const auto numbered = [&](std::size_t index) {
        return device{r.as, r.of->first + static_cast<std::uint32_t>(index)};
    };
    map_target target{numbered(begin), numbered(end - 1)};
    if (per_device == 1)
        target.first_bit = static_cast<unsigned>(begin - r.first);
    if (per_device == 32 && r.count == 16)
        target.of_device = r.first % 32 == 0 ? map_target::part::low_word : map_target::part::high_word;
    return target;
}

std::optional<device_address> address_in(const model& m, const map_row& row, device d)
{
    const run r = run_of(m, row);
    if (area_of(m, d) != r.of)
        return std::nullopt;
    const std::size_t bit = *first_bit(*r.of, d);
    const std::size_t size = bits_of(*r.of, d.kind);
    if (bit < r.first || bit + size > r.first + r.count)
        return std::nullopt;
    const std::size_t distance = bit - r.first;
    device_address found{{row.table, row.first + static_cast<std::uint32_t>(distance / step_of(row))}, 1, {}};
    if (size > step_of(row))
        found.count = static_cast<std::uint32_t>(size / step_of(row));
    if (size == 1 && step_of(row) == 16)
        found.bit = static_cast<unsigned>(distance % 16);
    return found;
}

}  // namespace

std::vector<device_address> addresses_of(const model& m, map_rows rows, device d)
{
    std::vector<device_address> found;
    if (!exists(m, d))
        return found;
    for (const map_row& row : rows)
        if (const auto at = address_in(m, row, d))
            found.push_back(*at);
    std::stable_sort(found.begin(), found.end(),
                     [](const device_address& a, const device_address& b) { return a.at.table < b.at.table; });
    return found;
}

std::optional<map_target> target_of(const model& m, map_rows rows, map_address at)
{
    for (const map_row& row : rows) {
        if (row.table != at.table || at.number < row.first || at.number - row.first >= row.count)
            continue;
        run r = run_of(m, row);
        r.first += (at.number - row.first) * step_of(row);
        r.count = step_of(row);
        return target_of_run(r);
    }
    return std::nullopt;
}

map_target target_of(const model& m, const map_row& row) { return target_of_run(run_of(m, row)); }

std::string name_of(const model& m, device d)
{
    std::string name = to_string(d, m.names);
    const bool timer = d.kind == device_kind::ts || d.kind == device_kind::tn || d.kind == device_kind::cs ||
                       d.kind == device_kind::cn;
    if (timer && m.timers == timer_names::plain)
        name.erase(1, 1);
    return name;
}

std::string names_of(const model& m, device first, device last)
{
    return first == last ? name_of(m, first) : name_of(m, first) + "-" + name_of(m, last);
}

std::string ranges_of(const model& m, device_kind kind)
{
    std::string text;
    for (const area& a : m.areas) {
        if (kind != a.kind && kind != a.words)
            continue;
        const auto devices = static_cast<std::uint32_t>(a.count * a.bits_per_device / bits_of(a, kind));
        text.append(text.empty() ? "" : ", ")
            .append(names_of(m, {kind, a.first + a.absent}, {kind, a.first + devices - 1}));
    }
    return text;
}

reference reference_of(map_address at)
{
    constexpr char digits[] = {'0', '1', '3', '4'};  // in the order of modbus::table
    const auto padded = [&](std::size_t width) {
        const std::string number = std::to_string(at.number + 1);
        if (number.size() > width)
            return std::string();
        return digits[static_cast<std::size_t>(at.table)] + std::string(width - number.size(), '0') + number;
    };
    return {padded(4), padded(5)};
}

}  // namespace plcgw::plc
