#include "daemon/plan_command.hpp"

#include "bridge/routes/plan_reasons.hpp"
#include "daemon/config/read.hpp"
#include "daemon/run.hpp"
#include "daemon/state_path.hpp"
#include "daemon/station_reading.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace plcgw {
namespace {

station_limits limits_of(const learned_by_station& learned, const std::string& line, unsigned unit)
{
    const auto found = learned.find({line, unit});
    return found == learned.end() ? station_limits{} : found->second;
}

struct planned_station {
    station_wants wants;
    station_limits limits;
    read_plan plan;
};

std::vector<planned_station> plans_of(const gateway_config& config, const line_config& line,
                                      const learned_by_station& learned)
{
    std::vector<planned_station> made;
    for (station_wants& each : wants_of(config, line)) {
        station_limits limits = limits_of(learned, line.name, each.station->unit);
        read_plan plan = plan_reads(each.wanted, each.how, limits);
        made.push_back({std::move(each), std::move(limits), std::move(plan)});
    }
    return made;
}

double ms(duration d) { return static_cast<double>(d.count()) / 1000; }

double capacity_of(const line_config& line)
{
    return line.protocol == line_protocol::modbus_tcp ? line.max_outstanding : 1;
}

double needed_of(const std::vector<planned_station>& stations, double capacity)
{
    double sum = 0;
    for (const planned_station& each : stations)
        for (const planned_poll& poll : each.plan.polls)
            sum += share_of(poll) / capacity;
    return sum;
}

// The part of a poll's time that one of its routes takes: by the registers that each wants.
double part_of(const planned_poll& poll, const station_wants& of, std::size_t route)
{
    double all = 0;
    for (const std::size_t each : poll.routes)
        all += of.wanted[each].count;
    return of.wanted[route].count / all;
}

void add_rows(std::vector<std::string>& rows, const planned_station& of, double capacity)
{
    for (std::size_t i = 0; i < of.wants.routes.size(); ++i) {
        const auto poll = std::find_if(of.plan.polls.begin(), of.plan.polls.end(), [i](const planned_poll& each) {
            return std::binary_search(each.routes.begin(), each.routes.end(), i);
        });
        const double share = share_of(*poll) / capacity * part_of(*poll, of.wants, i);
        rows.push_back(
            fmt::format("  {:<32} {:8.1f} ms/s {:6.1f} %", of.wants.routes[i]->name, 1000 * share, 100 * share));
    }
}

std::string overload_of(const line_config& line, double needed, const std::vector<planned_station>& stations)
{
    if (needed <= 1)
        return {};
    std::set<milliseconds> periods;
    for (const planned_station& each : stations)
        for (const route_config* const route : each.wants.routes)
            periods.insert(route->period);
    std::string text;
    for (const milliseconds each : periods)
        text +=
            fmt::format("{}{} ms instead of {} ms", text.empty() ? "" : ", ",
                        static_cast<std::int64_t>(std::ceil(static_cast<double>(each.count()) * needed)), each.count());
    return fmt::format("{} needs {:.0f} %: these periods are reachable: {}", line.name, std::ceil(100 * needed), text);
}

void print(const planned_station& of)
{
    fmt::print("  {} (unit {}), turnaround {:.1f} ms{}{}\n", of.wants.station->name, of.wants.station->unit,
               ms(of.limits.turnaround.value_or(of.wants.how.bus.turnaround)),
               of.limits.turnaround ? " measured" : " assumed",
               of.plan.is_optimal ? "" : ", too many periods to look at everything");
    const auto reasons = why_apart(of.plan, of.wants.wanted, of.wants.how, of.limits);
    for (std::size_t i = 0; i < of.plan.polls.size(); ++i) {
        const planned_poll& poll = of.plan.polls[i];
        const read_block at = block_of(poll);
        std::string routes;
        for (const std::size_t each : poll.routes)
            routes += " " + of.wants.routes[each]->name;
        const std::string last = at.end - at.first == 1 ? "" : fmt::format("-{}", at.end - 1);
        fmt::print("    {} {}{} every {} ms, {:.1f} ms, {:.1f} ms/s:{}\n", area_name(poll.there), at.first, last,
                   poll.period.count() / 1000, ms(poll.cost), 1000 * share_of(poll), routes);
        if (!reasons[i].empty())
            fmt::print("      split: {}\n", reasons[i]);
    }
    for (const auto& [area, table] : of.limits.tables)
        for (const learned_limit& each : table.all())
            fmt::print("    learned on {}: {} ({})\n", date_of(each.since), to_string(each, area), each.reason);
}

}  // namespace

learned_by_station learned_for(const gateway_config& config)
{
    const learned_store store(state_folder(config.state.folder));
    learned_store::loaded kept = store.load();
    if (!kept.problem.empty())
        fmt::print(stderr, "{} {}\n", store.file().string(), kept.problem);
    return std::move(kept.stations);
}

std::vector<line_load> loads_of(const gateway_config& config, const learned_by_station& learned)
{
    std::vector<line_load> made;
    for (const line_config& line : config.lines) {
        if (!polls(line))
            continue;
        const auto stations = plans_of(config, line, learned);
        line_load& load = made.emplace_back();
        load.line = line.name;
        load.needed = needed_of(stations, capacity_of(line));
        for (const planned_station& each : stations)
            add_rows(load.rows, each, capacity_of(line));
        load.overload = overload_of(line, load.needed, stations);
    }
    return made;
}

int show_plan(const std::filesystem::path& config_file, const std::string& line)
{
    const config::loaded loaded = config::load_file(config_file);
    if (config::has_errors(loaded.found))
        return check(config_file, true);  // says what is wrong with it
    const learned_by_station learned = learned_for(loaded.config);
    bool any = false;
    for (const line_config& each : loaded.config.lines) {
        if (!polls(each) || (!line.empty() && each.name != line))
            continue;
        any = true;
        const auto stations = plans_of(loaded.config, each, learned);
        const double needed = needed_of(stations, capacity_of(each));
        fmt::print("{}: {:.1f} ms/s, {:.1f} %\n", each.name, 1000 * needed, 100 * needed);
        for (const planned_station& station : stations)
            if (!station.plan.polls.empty())
                print(station);
    }
    if (!any && !line.empty()) {
        fmt::print(stderr, "{} is no line that polls stations\n", line);
        return 1;
    }
    return 0;
}

}  // namespace plcgw
