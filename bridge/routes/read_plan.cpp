#include "bridge/routes/read_plan.hpp"

#include <algorithm>

namespace plcgw {
namespace {

read_block block_of(const wanted_read& w) { return {number(w.there), number(w.there) + w.count}; }

void add_each_alone(read_plan& plan, const std::vector<wanted_read>& wanted, const std::vector<std::size_t>& area,
                    const request_rules& rules)
{
    for (const std::size_t each : area) {
        const wanted_read& w = wanted[each];
        plan.polls.push_back({w.there, w.count, w.period, {each}, rules.cost(block_of(w))});
    }
}

void add_merged(read_plan& plan, const std::vector<wanted_read>& wanted, const std::vector<std::size_t>& area,
                const request_rules& rules)
{
    std::vector<read_span> spans;
    for (const std::size_t each : area)
        spans.push_back({block_of(wanted[each]), wanted[each].period});
    const merged_reads merged = merge_reads(spans, rules.for_merging());
    plan.is_optimal = plan.is_optimal && merged.is_optimal;
    for (const merged_read& each : merged.requests) {
        planned_poll poll{moved_to(wanted[area.front()].there, each.at.first),
                          each.at.end - each.at.first,
                          each.period,
                          {},
                          rules.cost(each.at)};
        for (const std::size_t i : each.routes)
            poll.routes.push_back(area[i]);
        plan.polls.push_back(std::move(poll));
    }
}

}  // namespace

read_block block_of(const planned_poll& p) { return {number(p.there), number(p.there) + p.count}; }

request_rules::request_rules(const std::vector<wanted_read>& area, const read_settings& how,
                             const station_limits& limits)
    : any_(area.front().there), how_(how)
{
    how_.bus.turnaround = limits.turnaround.value_or(how.bus.turnaround);
    if (const auto learned = limits.tables.find(area_name(any_)); learned != limits.tables.end())
        limits_ = &learned->second;
    std::vector<read_block> blocks;
    for (const wanted_read& each : area)
        blocks.push_back(block_of(each));
    std::sort(blocks.begin(), blocks.end());
    for (const read_block& each : blocks)
        if (!covered_.empty() && each.first <= covered_.back().end)
            covered_.back() = joined(covered_.back(), each);
        else
            covered_.push_back(each);
}

bool request_rules::is_too_long(const read_block& b) const
{
    const unsigned most = is_bits(any_) ? how_.max_bits : how_.max_registers;
    return (most != 0 && b.end - b.first > most) || !is_one_exchange(how_.bus, question(b));
}

bool request_rules::reads_unwanted(const read_block& b) const
{
    return std::none_of(covered_.begin(), covered_.end(), [&](const read_block& each) { return covers(each, b); });
}

merge_rules request_rules::for_merging() const
{
    return {.cost = [this](const read_block& b) { return cost(b); },
            .allowed = [this](const read_block& b) { return allowed(b); }};
}

read_plan plan_reads(const std::vector<wanted_read>& wanted, const read_settings& how, const station_limits& limits)
{
    std::map<std::string, std::vector<std::size_t>> areas;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        areas[area_name(wanted[i].there)].push_back(i);
    read_plan plan;
    for (const auto& [name, area] : areas) {
        std::vector<wanted_read> of_area;
        for (const std::size_t each : area)
            of_area.push_back(wanted[each]);
        const request_rules rules(of_area, how, limits);
        if (how.merge == merge_mode::off)
            add_each_alone(plan, wanted, area, rules);
        else
            add_merged(plan, wanted, area, rules);
    }
    return plan;
}

}  // namespace plcgw
