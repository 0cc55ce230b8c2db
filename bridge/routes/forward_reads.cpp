#include "bridge/routes/forward_reads.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned most_bits = 2000;
constexpr unsigned most_registers = 125;
constexpr std::size_t most_entries = 64;  // of one station

unsigned first_of(const modbus::read_table& r) { return modbus::number(r.first); }
unsigned end_of(const modbus::read_table& r) { return first_of(r) + r.count; }

bool contains(const modbus::read_table& whole, const modbus::read_table& part)
{
    return whole.from == part.from && first_of(whole) <= first_of(part) && end_of(part) <= end_of(whole);
}

template <class Values>
Values slice(const Values& of, unsigned from, unsigned count)
{
    const auto begin = of.begin() + static_cast<std::ptrdiff_t>(from);
    return Values(begin, begin + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

std::optional<modbus::read_table> joined(const modbus::read_table& a, const modbus::read_table& b)
{
    if (a.from != b.from || first_of(a) > end_of(b) || first_of(b) > end_of(a))
        return std::nullopt;
    const unsigned first = std::min(first_of(a), first_of(b));
    const unsigned count = std::max(end_of(a), end_of(b)) - first;
    if (count > (modbus::is_bit_table(a.from) ? most_bits : most_registers))
        return std::nullopt;
    return modbus::read_table{a.from, modbus::address{static_cast<std::uint16_t>(first)},
                              static_cast<std::uint16_t>(count)};
}

modbus::response part_of(const modbus::response& answer, const modbus::read_table& whole,
                         const modbus::read_table& part)
{
    const unsigned from = first_of(part) - first_of(whole);
    if (const auto* const bits = std::get_if<modbus::bits_read>(&answer))
        return modbus::bits_read{slice(bits->values, from, part.count)};
    if (const auto* const registers = std::get_if<modbus::registers_read>(&answer))
        return modbus::registers_read{slice(registers->values, from, part.count)};
    return answer;
}

bool may_be_due_to_others(const modbus::response& answer)
{
    const auto* const code = std::get_if<modbus::exception_code>(&answer);
    return code != nullptr && (*code == modbus::exception_code::illegal_data_address ||
                               *code == modbus::exception_code::illegal_data_value ||
                               *code == modbus::exception_code::server_device_failure);
}

std::optional<modbus::response> read_cache::find(station_number unit, const modbus::read_table& what,
                                                 time_point now) const
{
    const auto of = entries_.find(unit);
    if (of == entries_.end())
        return std::nullopt;
    const auto found = std::find_if(of->second.rbegin(), of->second.rend(), [&](const entry& each) {
        return now - each.at <= most_age_ && contains(each.what, what);
    });
    if (found == of->second.rend())
        return std::nullopt;
    return part_of(found->answer, found->what, what);
}

void read_cache::store(station_number unit, const modbus::read_table& what, const modbus::response& answer,
                       time_point asked_at, time_point now)
{
    const bool has_values =
        std::holds_alternative<modbus::bits_read>(answer) || std::holds_alternative<modbus::registers_read>(answer);
    if (most_age_ == duration{} || !has_values)
        return;
    for (const station_number written : {unit, station_number{0}})
        if (const auto found = written_at_.find(written); found != written_at_.end() && asked_at < found->second)
            return;
    std::deque<entry>& of = entries_[unit];
    std::erase_if(of, [&](const entry& each) { return contains(what, each.what) || now - each.at > most_age_; });
    if (of.size() >= most_entries)
        of.pop_front();
    of.push_back({what, answer, now});
}

// A broadcast reaches all of them.
void read_cache::forget(station_number unit, time_point now)
{
    written_at_[unit] = now;
    if (number(unit) == 0)
        forget_all();
    else
        entries_.erase(unit);
}

}  // namespace plcgw
