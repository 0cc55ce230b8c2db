#include "daemon/pair_mirror.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned most_at_a_time = 200;  // samples; the lines do not wait for more

}  // namespace

pair_mirror::pair_mirror(const std::vector<std::unique_ptr<plc::simulated_plc>>& plcs, const line_list& lines,
                         hearing hears)
    : plcs_(plcs), lines_(lines), hears_(std::move(hears))
{
    for (const auto& each : plcs)
        memory_.add(*each);
    for (std::size_t line = 0; line < lines.size(); ++line)
        for (std::size_t row = 0; row < lines[line]->routes.rows(); ++row)
            index(line, row);
}

void pair_mirror::index(std::size_t line, std::size_t row)
{
    const client_line& routes = lines_[line]->routes;
    const route& r = routes.route_at(row);
    rows_[{r.name, routes.is_half(row)}] = {line, row};
    if (writes(r.way))
        writes_[{line, row}] = 0;
    if (!reads(r.way))
        return;
    const std::size_t last = memory_mirror::chunk_of(r.at.bit + bits_of(r) - 1);
    for (std::size_t chunk = memory_mirror::chunk_of(r.at.bit); chunk <= last; ++chunk)
        filled_[{r.plc, r.at.area, chunk}].push_back({line, row});
}

void pair_mirror::say_everything()
{
    memory_.say_everything();
    for (const auto& [name, where] : rows_)
        changed_.insert(where);
}

void pair_mirror::say_route(const std::string& name)
{
    if (const auto found = rows_.find({name, false}); found != rows_.end())
        changed_.insert(found->second);
}

void pair_mirror::say_writes(const running_line& line)
{
    for (auto& [where, said] : writes_) {
        if (lines_[where.line].get() != &line)
            continue;
        const route& r = line.routes.route_at(where.row);
        if (std::exchange(said, r.answers + r.errors) != r.answers + r.errors)
            changed_.insert(where);
    }
}

bool pair_mirror::publish(pair_port& port, std::uint64_t term)
{
    term_ = std::max(term_, term);
    unsigned left = most_at_a_time;
    for (; left > 0; --left) {
        auto chunk = memory_.next();
        if (!chunk)
            break;
        chunk->term = term;
        port.publish(*chunk);
    }
    for (; left > 0 && !changed_.empty(); --left) {
        port.publish(record_of(*changed_.begin(), term));
        changed_.erase(changed_.begin());
    }
    return left > 0;
}

route_record pair_mirror::record_of(const row_key& which, std::uint64_t term) const
{
    const client_line& routes = lines_[which.line]->routes;
    const route& r = routes.route_at(which.row);
    return {r.name, routes.is_half(which.row), term, r.state, r.source, r.reason_code, r.answers, r.errors, r.reason,
            r.words};
}

// What was read by others is known here at the same time as there: then the mirror is the older one.
memory_mirror::own_bits pair_mirror::own_bits_of(const memory_chunk& chunk, time_point now) const
{
    memory_mirror::own_bits own(chunk.words.size());
    const auto plc =
        std::find_if(plcs_.begin(), plcs_.end(), [&](const auto& each) { return each->name() == chunk.plc; });
    if (plc == plcs_.end())
        return own;
    const std::size_t first_bit = std::size_t{16} * chunk.first;
    const auto found = filled_.find({plc->get(), chunk.area, memory_mirror::chunk_of(first_bit)});
    if (found == filled_.end())
        return own;
    for (const row_key& each : found->second) {
        const route& r = lines_[each.line]->routes.route_at(each.row);
        if (r.answers == 0 || !hears_(each.line, now))
            continue;
        const std::size_t begin = std::max(r.at.bit, first_bit);
        const std::size_t end = std::min(r.at.bit + bits_of(r), first_bit + 16 * own.size());
        for (std::size_t bit = begin; bit < end; ++bit)
            own[(bit - first_bit) / 16] = static_cast<std::uint16_t>(own[(bit - first_bit) / 16] | 1U << bit % 16);
    }
    return own;
}

void pair_mirror::take(const memory_chunk& chunk, time_point now)
{
    if (chunk.term < term_)
        return;
    term_ = chunk.term;
    if (!memory_.apply(chunk, own_bits_of(chunk, now)))
        misfit_ = "PLC " + chunk.plc;
}

void pair_mirror::take(const route_record& record, time_point now, wall_time wall)
{
    const auto found = rows_.find({record.route, record.writes});
    if (record.term < term_)
        return;
    if (found == rows_.end()) {
        misfit_ = "route " + record.route;
        return;
    }
    const row_key& where = found->second;
    client_line& routes = lines_[where.line]->routes;
    if (routes.route_at(where.row).answers == 0 || !hears_(where.line, now))
        routes.adopt(where.row, record, now, wall);
}

}  // namespace plcgw
