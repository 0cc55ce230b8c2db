#include "bridge/routes/station_statistics.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int cycle_weight = 8;  // as response_times smooths

}  // namespace

void station_statistics::add_read(std::size_t station, std::size_t route, duration period)
{
    row* const of = find(station);
    if (of == nullptr || (of->watched && of->watched_period <= period))
        return;
    of->watched = route;
    of->watched_period = period;
}

void station_statistics::set(row& of, link_state state, const std::string& detail)
{
    changed_ = changed_ || of.status.state != state;
    of.status.state = state;
    of.status.detail = detail;
}

// Whether a station still is there shows its first answer.
void station_statistics::port_opened()
{
    open_ = true;
    for (row& each : stations_) {
        each.answered = false;
        each.read_at = {};
        set(each, link_state::starting, "not asked since the port was opened");
    }
}

void station_statistics::port_lost(const std::string& why)
{
    open_ = false;
    for (row& each : stations_)
        set(each, link_state::down, why);
}

void station_statistics::unanswered(std::size_t station, bool timed_out)
{
    if (row* const of = find(station)) {
        ++of->status.requests;
        of->status.timeouts += timed_out ? 1 : 0;
    }
}

void station_statistics::answered(std::size_t station, const std::string* refusal, wall_time wall)
{
    row* const of = find(station);
    if (of == nullptr)
        return;
    ++of->status.requests;
    of->answered = true;
    if (refusal == nullptr) {
        of->status.last_ok = wall;
        return;
    }
    ++of->status.exceptions;
    if (of->refusal != *refusal)
        of->refusal = *refusal;
}

void station_statistics::was_read(std::size_t station, std::size_t route, time_point now)
{
    row* const of = find(station);
    if (of == nullptr || of->watched != route)
        return;
    const time_point before = std::exchange(of->read_at, now);
    if (before == time_point{})
        return;
    if (of->cycle == duration{})
        of->cycle = now - before;
    of->cycle += (now - before - of->cycle) / cycle_weight;
}

void station_statistics::is(std::size_t station, health state, const std::string& reason)
{
    row* const of = find(station);
    if (of == nullptr || !open_)
        return;
    switch (state) {
    case health::healthy:
        if (of->answered && of->status.state != link_state::up)
            set(*of, link_state::up, {});
        return;
    case health::suspect:
        if (of->status.state != link_state::degraded)
            set(*of, link_state::degraded, "the last request was not answered: " + reason);
        return;
    case health::down:
        if (of->status.state != link_state::down)
            set(*of, link_state::down, "does not answer: " + reason);
        return;
    }
}

device_status station_statistics::status_of(std::size_t station) const
{
    const row& of = stations_[station];
    device_status status = of.status;
    status.cycle_us = static_cast<std::uint32_t>(std::clamp<std::int64_t>(of.cycle.count(), 0, UINT32_MAX));
    if (status.state == link_state::up && !of.refusal.empty())
        status.detail = "last refusal: " + of.refusal;
    return status;
}

}  // namespace plcgw
