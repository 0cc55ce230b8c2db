#include "bridge/routes/schedule.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int probe_share = 20;  // a probe is followed by 19 times its duration without one
constexpr duration idle_check = std::chrono::seconds(1);
constexpr duration first_round = std::chrono::seconds(1);   // in which every poll is read for the first time
constexpr duration slack = std::chrono::milliseconds(100);  // time on the wire and jitter of a late answer

}  // namespace

std::size_t schedule::add_poll(std::size_t station, duration period)
{
    items_.push_back({station, period, {}, false, false});
    return items_.size() - 1;
}

std::size_t schedule::add_write(std::size_t station)
{
    items_.push_back({station, {}, {}, false, false});
    return items_.size() - 1;
}

void schedule::start(time_point now)
{
    const auto count = static_cast<std::int64_t>(items_.size());
    for (std::int64_t i = 0; i < count; ++i) {
        item_state& each = items_[static_cast<std::size_t>(i)];
        if (each.period != duration{})
            each.due = now + std::min(each.period, first_round) * i / count;
    }
}

// When an item may go, as far as its own state and its station's health allow; time_point::max() = not now.
time_point schedule::ready_at(std::size_t index) const
{
    const item_state& each = items_[index];
    if (each.in_flight)
        return time_point::max();
    const station_state& of = stations_[each.station];
    const time_point own = each.period != duration{} || each.asked ? each.due : time_point::max();
    switch (of.health.state()) {
    case health::healthy: return std::max(own, of.not_before);
    // The same question again: should the answer to the failed one come late, it answers this one.
    case health::suspect: return index == of.failed_item ? own : time_point::max();
    case health::down: break;
    }
    return index == of.failed_item ? std::max(of.health.probe_at(), probe_not_before_) : time_point::max();
}

std::optional<std::size_t> schedule::first_probe(time_point now) const
{
    std::optional<std::size_t> first;
    time_point oldest = time_point::max();
    for (const station_state& each : stations_) {
        if (each.health.state() != health::down || ready_at(each.failed_item) > now)
            continue;
        if (each.health.probe_at() < oldest) {
            oldest = each.health.probe_at();
            first = each.failed_item;
        }
    }
    return first;
}

std::optional<std::size_t> schedule::first_write(time_point now) const
{
    for (std::size_t n = 1; n <= items_.size(); ++n) {
        const std::size_t index = (last_write_ + n) % items_.size();
        const item_state& each = items_[index];
        if (each.period == duration{} && stations_[each.station].health.state() != health::down &&
            ready_at(index) <= now)
            return index;
    }
    return std::nullopt;
}

std::optional<std::size_t> schedule::first_poll(time_point now) const
{
    std::optional<std::size_t> first;
    time_point earliest = time_point::max();
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const item_state& each = items_[i];
        if (each.period == duration{} || stations_[each.station].health.state() == health::down)
            continue;
        if (ready_at(i) <= now && each.due + each.period < earliest) {
            earliest = each.due + each.period;
            first = i;
        }
    }
    return first;
}

std::optional<schedule::turn> schedule::next(time_point now)
{
    // Probes first: their share is limited, and behind the polls of a full line they would never come.
    if (const auto probe = first_probe(now)) {
        items_[*probe].in_flight = true;
        items_[*probe].asked = false;
        return turn{*probe, false};
    }

    const auto write = first_write(now);
    const auto poll = first_poll(now);
    // Writes before polls, but a client that writes without end leaves every other turn to the polls.
    const bool write_now = write && !(poll && wrote_last_);
    const auto chosen = write_now ? write : poll;
    if (!chosen)
        return std::nullopt;
    wrote_last_ = write_now;
    if (write_now) {
        last_write_ = *write;
        items_[*write].asked = false;
    }
    items_[*chosen].in_flight = true;
    return turn{*chosen, state_of(items_[*chosen].station) == health::healthy};
}

time_point schedule::wake_at(time_point now) const
{
    time_point earliest = now + idle_check;
    for (std::size_t i = 0; i < items_.size(); ++i)
        earliest = std::min(earliest, ready_at(i));
    return earliest;
}

void schedule::finished(const turn& done, outcome how, duration took, time_point now, unanswered_requests late)
{
    item_state& each = items_[done.item];
    each.in_flight = false;
    station_state& of = stations_[each.station];
    const bool was_probe = of.health.state() == health::down;

    if (how == outcome::silent && late.count == 0)
        late = {1, now - took};
    remember_unanswered(of, late, now);
    if (how == outcome::answered) {
        of.health.answered();
        // The answer may belong to the first of the unanswered requests. Then the other answers follow, each at most as
        // late as this one was, also from a device that works them off one by one. They must not meet another question.
        if (of.owed != 0)
            of.not_before = now + std::min<duration>(of.owed * (now - of.owed_since), of.longest_delay) + slack;
        of.owed = 0;
    }
    else if (how == outcome::silent) {
        if (of.health.state() == health::healthy)
            of.failed_item = done.item;
        of.health.failed(now);
    }
    if (how != outcome::answered && each.period == duration{})
        each.asked = true;  // a write that nobody took is still wanted
    if (was_probe)
        probe_not_before_ = now + (probe_share - 1) * took;
    if (each.period != duration{} && of.health.state() != health::suspect)  // else it is asked again at once
        advance(each, now);
}

// Who was silent for longer than any answer takes owes none.
void schedule::remember_unanswered(station_state& of, unanswered_requests late, time_point now)
{
    if (of.owed != 0 && now - of.last_silence > of.longest_delay)
        of.owed = 0;
    if (late.count == 0)
        return;
    if (of.owed == 0)
        of.owed_since = late.since;
    of.owed += late.count;
    of.last_silence = now;
}

// The next due time keeps its phase. What was missed is skipped, not caught up: a line that stood still for an hour
// does not ask everything 3600 times.
void schedule::advance(item_state& of, time_point now)
{
    of.due += of.period;
    if (of.due + of.period < now)
        of.due += ((now - of.due) / of.period + 1) * of.period;
}

}  // namespace plcgw
