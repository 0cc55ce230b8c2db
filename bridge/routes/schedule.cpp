#include "bridge/routes/schedule.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

constexpr duration idle_check = std::chrono::seconds(1);
constexpr duration first_round = std::chrono::seconds(1);   // in which every poll is read for the first time
constexpr duration slack = std::chrono::milliseconds(100);  // time on the wire and jitter of a late answer

constexpr lane order[] = {lane::write, lane::forward, lane::poll, lane::probe};  // and then a scan

}  // namespace

schedule::schedule(std::size_t stations)
{
    for (std::size_t i = 0; i < stations; ++i)
        add_station();
}

std::size_t schedule::add_station()
{
    station_state added;
    added.health = station_health(static_cast<std::uint32_t>(stations_.size()));
    stations_.push_back(added);
    return stations_.size() - 1;
}

std::size_t schedule::add_item(std::size_t station, duration period)
{
    items_.push_back({station, period, {}, false, false});
    load_.add(period);
    return items_.size() - 1;
}

std::size_t schedule::add_poll(std::size_t station, duration period)
{
    const std::size_t added = add_item(station, period);
    if (!stations_[station].first_poll)
        stations_[station].first_poll = added;
    return added;
}

std::size_t schedule::add_write(std::size_t station)
{
    const std::size_t added = add_item(station, {});
    if (!stations_[station].a_write)
        stations_[station].a_write = added;
    return added;
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
    const bool is_its_turn = !of.failed_item || index == *of.failed_item;
    switch (of.health.state()) {
    case health::healthy: return std::max(own, of.not_before);
    // The same question again: should the answer to the failed one come late, it answers this one.
    case health::suspect: return is_its_turn ? std::max(own, of.not_before) : time_point::max();
    case health::down: break;
    }
    const bool is_probe = of.failed_item ? is_its_turn : each.asked || index == of.probe();
    return is_probe ? std::max({of.health.probe_at(), of.not_before, shares_.credit_from(lane::probe)})
                    : time_point::max();
}

std::optional<std::size_t> schedule::first_probe(time_point now) const
{
    std::optional<std::size_t> first;
    time_point oldest = time_point::max();
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const station_health& of = stations_[items_[i].station].health;
        if (of.state() == health::down && of.probe_at() < oldest && ready_at(i) <= now) {
            oldest = of.probe_at();
            first = i;
        }
    }
    return first;
}

std::optional<std::size_t> schedule::first_write(time_point now) const
{
    for (std::size_t n = 1; n <= items_.size(); ++n) {
        const std::size_t index = (last_write_ + n) % items_.size();
        const item_state& each = items_[index];
        if (each.period == duration{} && state_of(each.station) != health::down && ready_at(index) <= now)
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
        if (each.period == duration{} || state_of(each.station) == health::down)
            continue;
        const time_point deadline = each.due + period_now(each);
        if (ready_at(i) <= now && deadline < earliest) {
            earliest = deadline;
            first = i;
        }
    }
    return first;
}

std::optional<std::size_t> schedule::first_of(lane which, time_point now) const
{
    switch (which) {
    case lane::write: return first_write(now);
    case lane::poll: return first_poll(now);
    case lane::probe: return first_probe(now);
    case lane::forward:
    case lane::scan: break;
    }
    return std::nullopt;
}

time_point schedule::first_ready() const
{
    time_point earliest = time_point::max();
    for (std::size_t i = 0; i < items_.size(); ++i)
        earliest = std::min(earliest, ready_at(i));
    return earliest;
}

bool schedule::may_scan(time_point now, bool others_wait) const
{
    if (!scan_)
        return false;
    const bool is_in_gap = !others_wait && now + *scan_ <= first_ready();
    return is_in_gap || shares_.has_credit(lane::scan, now);
}

schedule::turn schedule::take(lane which, std::size_t index)
{
    item_state& each = items_[index];
    each.in_flight = true;
    const bool is_wanted = std::exchange(each.asked, false) || each.period != duration{};
    if (which == lane::write)
        last_write_ = index;
    return {index, which != lane::probe && state_of(each.station) == health::healthy, which, is_wanted};
}

std::optional<schedule::turn> schedule::next(time_point now, bool forward_waits)
{
    std::optional<turn> chosen;  // of the lanes that had their share, the one that will have credit first
    bool is_entitled = false;
    for (const lane which : order) {
        const bool in_share = shares_.has_credit(which, now);
        if (chosen && !in_share && shares_.credit_from(which) >= shares_.credit_from(chosen->of))
            continue;
        const auto item = first_of(which, now);
        if (!item && !(which == lane::forward && forward_waits))
            continue;
        chosen = turn{item.value_or(0), true, which};
        is_entitled = in_share;
        if (in_share)
            break;
    }
    if (!is_entitled && may_scan(now, chosen.has_value()))
        return turn{0, false, lane::scan};
    if (chosen && chosen->of != lane::forward)
        return take(chosen->of, chosen->item);
    return chosen;
}

time_point schedule::wake_at(time_point now) const
{
    const time_point earliest = std::min(now + idle_check, first_ready());
    return scan_ ? std::min(earliest, std::max(now, shares_.credit_from(lane::scan))) : earliest;
}

time_point schedule::forward_at(std::size_t station) const
{
    const station_state& of = stations_[station];
    switch (of.health.state()) {
    case health::healthy: return of.not_before;
    case health::suspect: return of.failed_item ? time_point::max() : of.not_before;
    case health::down: break;
    }
    return std::max({of.health.probe_at(), of.not_before, shares_.credit_from(lane::probe)});
}

bool schedule::is_given_up(std::size_t station, time_point now) const
{
    const station_state& of = stations_[station];
    if (of.health.state() != health::down)
        return false;
    return of.failed_item || of.probe() || forward_at(station) > now;
}

void schedule::finished(const turn& done, outcome how, duration took, time_point now, unanswered_requests late)
{
    item_state& each = items_[done.item];
    each.in_flight = false;
    station_state& of = stations_[each.station];

    count_time(done.of, took, now);
    if (how == outcome::answered && done.of == lane::poll)
        load_.took(done.item, took);
    if (how == outcome::silent && late.count == 0)
        late = {1, now - took};
    if (how == outcome::silent && of.health.state() != health::down && !of.failed_item)
        of.failed_item = done.item;
    heard(of, how, took, now, late);
    set_asked(each.station);
    if (how != outcome::answered && each.period == duration{} && done.is_wanted)
        each.asked = true;  // a write that nobody took is still wanted
    stretch_ = load_.stretch(now, parallel_);
    if (each.period != duration{} && of.health.state() != health::suspect)  // else it is asked again at once
        advance(each, now);
}

// Should it have failed, it does not hold up what else is asked of its station.
void schedule::forget(std::size_t item)
{
    items_[item].asked = false;
    station_state& of = stations_[items_[item].station];
    if (of.failed_item == item)
        of.failed_item.reset();
}

void schedule::pass(const turn& done, time_point now)
{
    finished(done, outcome::not_asked, {}, now);
    load_.took(done.item, {});
}

// A station with polls is not given up for what others ask of it: it may know the polls only. The next one shows.
void schedule::forwarded(std::size_t station, outcome how, duration took, time_point now, unanswered_requests late,
                         duration pause)
{
    station_state& of = stations_[station];
    const bool was_down = of.health.state() == health::down;
    count_time(was_down ? lane::probe : lane::forward, took, now);
    if (how == outcome::silent && late.count == 0)
        late = {1, now - took};
    if (how != outcome::silent || !of.first_poll) {
        heard(of, how, took, now, late);
    }
    else {
        remember_unanswered(of, late, now);
        of.health.doubted();
        of.failed_at = now;
        items_[*of.first_poll].due = std::min(items_[*of.first_poll].due, now);
    }
    if (how == outcome::silent)
        of.not_before = std::max(of.not_before, now + pause);
    set_asked(station);
}

void schedule::heard(station_state& of, outcome how, duration took, time_point now, unanswered_requests late)
{
    remember_unanswered(of, late, now);
    if (how == outcome::answered) {
        of.health.answered();
        of.failed_item.reset();
        // The answer may belong to the first of the unanswered requests. Then the other answers follow, each at most as
        // late as this one was, also from a device that works them off one by one. They must not meet another question.
        if (of.owed != 0)
            of.not_before = now + std::min<duration>(of.owed * (now - of.owed_since), of.longest_delay) + slack;
        of.owed = 0;
    }
    else if (how == outcome::silent && now - took >= of.failed_at) {
        of.health.failed(now);
        of.failed_at = now;
    }
}

// Who was silent for longer than any answer takes owes none.
void schedule::remember_unanswered(station_state& of, unanswered_requests late, time_point now)
{
    if (numbered_)
        return;
    if (of.owed != 0 && now - of.last_silence > of.longest_delay)
        of.owed = 0;
    if (late.count == 0)
        return;
    if (of.owed == 0)
        of.owed_since = late.since;
    of.owed += late.count;
    of.last_silence = now;
}

void schedule::count_time(lane which, duration took, time_point now)
{
    const duration of_line = took / parallel_;
    shares_.spent(which, of_line, now);
    if (which != lane::poll)
        load_.others_took(of_line, now);
}

// Only what is asked takes line time.
void schedule::set_asked(std::size_t station)
{
    const bool is = state_of(station) != health::down;
    if (std::exchange(stations_[station].counted, is) == is)
        return;
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (items_[i].station == station)
            load_.set_asked(i, is);
}

duration schedule::period_now(const item_state& of) const
{
    return duration(static_cast<std::int64_t>(static_cast<double>(of.period.count()) * stretch_));
}

// The next due time keeps its phase. What was missed is skipped, not caught up: a line that stood still for an hour
// does not ask everything 3600 times.
void schedule::advance(item_state& of, time_point now)
{
    const duration period = period_now(of);
    of.due += period;
    if (of.due + period < now)
        of.due += ((now - of.due) / period + 1) * period;
}

}  // namespace plcgw
