#include "bridge/routes/line_polls.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration first_round = std::chrono::milliseconds(250);  // in which every new poll is read for the first time
constexpr int smoothing = 8;                                      // of measured turnarounds

bool is_same(const line_polls::item& a, const line_polls::item& b)
{
    return a.routes == b.routes && a.first == b.first && a.count == b.count && a.period == b.period;
}

read_block block_of(const line_polls::item& poll) { return {number(poll.first), number(poll.first) + poll.count}; }

}  // namespace

line_polls::line_polls(std::vector<read_settings> stations)
{
    for (read_settings& each : stations)
        stations_.push_back({std::move(each), {}, {}});
}

void line_polls::add_read(std::size_t station, wanted_read wanted)
{
    stations_[station].reads.push_back({station_of_.size(), std::move(wanted)});
    station_of_.push_back(station);
}

void line_polls::add_write(std::size_t station)
{
    write_items_[station_of_.size()] = 0;
    station_of_.push_back(station);
}

std::vector<line_polls::item> line_polls::items_of(std::size_t station) const
{
    const station_reads& of = stations_[station];
    std::vector<wanted_read> wanted;
    for (const read_route& each : of.reads)
        wanted.push_back(each.wanted);
    std::vector<item> made;
    for (planned_poll& poll : plan_reads(wanted, of.how, of.limits).polls) {
        item& added = made.emplace_back();
        added.station = station;
        added.period = poll.period;
        added.first = poll.there;
        added.count = poll.count;
        for (const std::size_t i : poll.routes)
            added.routes.push_back(of.reads[i].route);
    }
    return made;
}

void line_polls::plan(schedule& into)
{
    std::map<std::size_t, item> by_first_route;
    for (std::size_t i = 0; i < stations_.size(); ++i)
        for (item& each : items_of(i))
            by_first_route[each.routes.front()] = std::move(each);
    for (const auto& [route, unset] : write_items_)
        by_first_route[route] = {station_of_[route], {}, {route}, {}, 0};
    for (auto& [route, each] : by_first_route) {
        const bool polls = each.period != duration{};
        const std::size_t index = polls ? into.add_poll(each.station, each.period) : into.add_write(each.station);
        if (!polls)
            write_items_[route] = index;
        items_.push_back(std::move(each));
    }
}

const line_polls::item& line_polls::at(std::size_t index) const
{
    if (is_needed(index))
        return items_[index];
    const auto other = std::find_if(items_.begin(), items_.end(), [&](const item& each) {
        return each.station == items_[index].station && each.period != duration{} && !each.routes.empty();
    });
    return other == items_.end() ? items_[index] : *other;
}

std::vector<read_block> line_polls::blocks_of(const item& poll) const
{
    std::vector<read_block> blocks;
    for (const read_route& each : stations_[poll.station].reads)
        if (std::binary_search(poll.routes.begin(), poll.routes.end(), each.route))
            blocks.push_back({number(each.wanted.there), number(each.wanted.there) + each.wanted.count});
    return blocks;
}

line_polls::lesson line_polls::refused(const item& poll, const station_refusal& why, wall_time wall, time_point now,
                                       schedule& polls)
{
    if (why.about == station_refusal::cause::other)
        return {true, {}};
    const std::string area = area_name(poll.first);
    table_limits& limits = stations_[poll.station].limits.tables[area];
    const auto found =
        limits.refused(block_of(poll), blocks_of(poll), why.about == station_refusal::cause::length, why.reason, wall);
    lesson made{found.blames_routes, {}};
    if (found.learned) {
        made.text = "refuses " + area + " " + std::to_string(number(poll.first)) + "-" +
                    std::to_string(block_of(poll).end - 1) + " in one request: " + why.reason + "; " +
                    to_string(*found.learned, area) + " from now on";
        learned_ = true;
        replan(poll.station, now, polls);
    }
    return made;
}

void line_polls::accepted(const item& poll, wall_time wall, time_point now, schedule& polls)
{
    table_limits& limits = stations_[poll.station].limits.tables[area_name(poll.first)];
    const bool forgot = limits.accepted(block_of(poll), wall);
    const bool tries = limits.begin_trial(wall);
    if (!forgot && !tries)
        return;
    learned_ = true;
    replan(poll.station, now, polls);
}

void line_polls::responded(std::size_t station, const station_question& asked, duration after)
{
    if (!is_one_exchange(stations_[station].how.bus, asked))
        return;
    const duration measured = turnaround_in(stations_[station].how.bus, asked, after);
    std::optional<duration>& kept = stations_[station].limits.turnaround;
    kept = kept ? *kept + (measured - *kept) / smoothing : measured;
}

// Polls that stay as they are keep their items and with them their phases. The others take the items that are left, of
// the same period, or new ones, and are asked soon: what was refused has not been read.
void line_polls::replan(std::size_t station, time_point now, schedule& polls)
{
    std::vector<item> wanted = items_of(station);
    std::vector<std::size_t> spare;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (items_[i].station != station || items_[i].period == duration{})
            continue;
        const auto same =
            std::find_if(wanted.begin(), wanted.end(), [&](const item& w) { return is_same(w, items_[i]); });
        if (same != wanted.end()) {
            wanted.erase(same);
            continue;
        }
        items_[i].routes.clear();
        spare.push_back(i);
    }
    for (std::size_t n = 0; n < wanted.size(); ++n) {
        const duration period = wanted[n].period;
        const auto free =
            std::find_if(spare.begin(), spare.end(), [&](std::size_t i) { return items_[i].period == period; });
        std::size_t index = items_.size();
        if (free != spare.end()) {
            index = *free;
            spare.erase(free);
            items_[index] = std::move(wanted[n]);
        }
        else {
            items_.push_back(std::move(wanted[n]));
            index = polls.add_poll(station, period);
        }
        const auto count = static_cast<std::int64_t>(wanted.size());
        polls.ask(index, now + std::min(period / 4, first_round) * static_cast<std::int64_t>(n) / count);
    }
}

std::size_t line_polls::item_of_read(std::size_t route) const
{
    const auto serves = [route](const item& each) {
        return each.period != duration{} &&
               std::find(each.routes.begin(), each.routes.end(), route) != each.routes.end();
    };
    return static_cast<std::size_t>(std::find_if(items_.begin(), items_.end(), serves) - items_.begin());
}

}  // namespace plcgw
