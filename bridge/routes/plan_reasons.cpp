#include "bridge/routes/plan_reasons.hpp"

#include <algorithm>
#include <cstdio>

namespace plcgw {
namespace {

std::string in_ms(duration d)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f ms", static_cast<double>(d.count()) / 1000);
    return text;
}

std::string period_text(duration d) { return std::to_string(d.count() / 1000) + " ms"; }

bool is_wanted_alone(const planned_poll& poll, const request_rules& rules) { return !rules.allowed(block_of(poll)); }

std::string of_gap(std::uint32_t gap) { return gap == 0 ? "no gap" : "a gap of " + std::to_string(gap); }

std::string reason(const planned_poll& a, const planned_poll& b, const request_rules& rules, const read_settings& how)
{
    const read_block all = joined(block_of(a), block_of(b));
    const std::uint32_t gap = block_of(b).first > block_of(a).end ? block_of(b).first - block_of(a).end : 0;
    if (how.merge == merge_mode::off)
        return "merge is off";
    if (const learned_limit* const limit = rules.refused(all))
        return "refused by the station on " + date_of(limit->since) + " (" + limit->reason +
               "): " + to_string(*limit, area_name(a.there));
    if (rules.is_too_long(all))
        return "together " + std::to_string(all.end - all.first) + ", more than the largest block";
    if (how.merge == merge_mode::adjacent && rules.reads_unwanted(all))
        return of_gap(gap) + ", and merge is adjacent";
    const duration together = rules.cost(all);
    if (a.period != b.period)
        return "another period: together they cost " + in_ms(together) + " every " +
               period_text(std::min(a.period, b.period));
    if (together >= a.cost + b.cost)
        return of_gap(gap) + " is dearer than a request: together they cost " + in_ms(together) + ", apart " +
               in_ms(a.cost + b.cost);
    return "dearer with the requests around them";
}

}  // namespace

double share_of(const planned_poll& p)
{
    return static_cast<double>(p.cost.count()) / static_cast<double>(p.period.count());
}

std::vector<std::string> why_apart(const read_plan& plan, const std::vector<wanted_read>& wanted,
                                   const read_settings& how, const station_limits& limits)
{
    std::vector<std::string> reasons(plan.polls.size());
    for (std::size_t i = 0; i + 1 < plan.polls.size(); ++i) {
        const std::string area = area_name(plan.polls[i].there);
        if (area != area_name(plan.polls[i + 1].there))
            continue;
        std::vector<wanted_read> of_area;
        for (const wanted_read& each : wanted)
            if (area_name(each.there) == area)
                of_area.push_back(each);
        const request_rules rules(of_area, how, limits);
        reasons[i] = reason(plan.polls[i], plan.polls[i + 1], rules, how);
        if (is_wanted_alone(plan.polls[i], rules) && how.merge != merge_mode::off &&
            !rules.refused(block_of(plan.polls[i])))
            reasons[i] += "; longer than the largest block itself";
    }
    return reasons;
}

std::string date_of(wall_time t)
{
    const std::int64_t seconds = static_cast<std::int64_t>(t) / 1'000'000'000;
    const std::chrono::sys_seconds at{std::chrono::seconds(seconds)};
    const auto day = std::chrono::floor<std::chrono::days>(at);
    const std::chrono::year_month_day date{day};
    const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(at - day).count();
    char text[40];
    std::snprintf(text, sizeof text, "%04d-%02u-%02u %02d:%02d", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(minutes / 60), static_cast<int>(minutes % 60));
    return text;
}

}  // namespace plcgw
