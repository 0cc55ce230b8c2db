// A line on which another member of the pair asks: what it is answered fills our routes, too, so that they are warm
// when we have to ask; and what it writes is not written again.
#include "bridge/routes/client_line.hpp"
#include "bridge/routes/overheard.hpp"
#include "bridge/routes/route_status.hpp"

#include <algorithm>

namespace plcgw {

void client_line::fall_silent()
{
    for (row& each : routes_)
        through_lost(each);
    forwards_.answer_all(errc::port_absent);
    port_open_ = false;
}

void client_line::begin_to_speak(time_point now)
{
    port_open_ = true;
    schedule_.start(now);
}

void client_line::overheard(station_number unit, const station_question& asked,
                            const std::optional<station_answer>& answer, time_point now, wall_time wall)
{
    const auto found =
        std::find_if(stations_.begin(), stations_.end(), [unit](const station& each) { return each.unit == unit; });
    if (found == stations_.end())
        return;
    const auto station = static_cast<std::size_t>(found - stations_.begin());
    if (!answer) {
        heard_silence(station, asked, now);
        return;
    }
    const health before = schedule_.state_of(station);
    unanswered_.erase(station);
    schedule_.overheard(station, schedule::outcome::answered, now);
    note_health(station, before, {});
    if (const auto why = refusal_in(*answer)) {
        heard_refusal(station, asked, *why);
        return;
    }
    if (const auto read = read_in(asked)) {
        question q{schedule::turn{}, unit, asked, {}, now, {}};
        q.item.first = read->first;
        q.item.count = read->count;
        heard_read(station, q, *answer, now, wall);
    }
    const auto written = written_in(asked);
    for (row& each : routes_) {
        route& r = each.content;
        if (!written || each.station != station || !writes(r.way) ||
            !overlap(written->first, static_cast<std::uint32_t>(written->values.size()), r.there, r.count))
            continue;
        std::vector<std::uint16_t> words = each.heard_written.empty() ? words_in_memory(r) : each.heard_written;
        overlay(words, r.there, r.count, *written);
        heard_write(each, std::move(words), now, wall);
    }
}

// The other's plan may differ from ours: each route takes its part of what was read.
void client_line::heard_read(std::size_t station, const question& q, const station_answer& answer, time_point now,
                             wall_time wall)
{
    for (row& each : routes_) {
        const route& r = each.content;
        if (each.station != station || !reads(r.way) || !covers(q.item.first, q.item.count, r.there, r.count))
            continue;
        question own = q;
        own.item.period = each.period;  // it is a read
        bring(each, own, answer, now, wall);
        each.answered = true;
    }
}

// What waits to be written in a row is newer than what was just written, unless it is the same.
void client_line::heard_write(row& of, std::vector<std::uint16_t> words, time_point now, wall_time wall)
{
    route& r = of.content;
    const bool is_periodic = r.way == direction::periodic_write;
    of.heard_written = std::move(words);
    const bool waits = is_write_due(of) && words_in_memory(r) != of.heard_written;
    if (waits && !is_periodic)
        return;
    if (is_periodic) {
        of.first_write.reset();
        of.next_write = now + of.period;
    }
    if (!waits) {
        put_words(r, of.heard_written);
        was_heard_written(of);
    }
    of.changed = of.changed || r.words != of.heard_written;
    r.words = of.heard_written;
    r.source = wall;
    of.good_at = now;
    of.answered = true;
    ++r.answers;
    if (of.through)
        of.agreed = r.words;
    if (of.half) {
        reading_row(of).agreed = r.words;
        reading_row(of).written_at = now;
    }
    set_quality(of, quality::good, {});
}

// What the memory holds now need not be written: the station has it. A periodic write waits for its next time.
bool client_line::was_heard_written(row& of)
{
    if (of.heard_written.empty() || words_in_memory(of.content) != of.heard_written)
        return false;
    of.first_write.reset();
    schedule_.forget(write_item(of));
    if (of.content.way == direction::periodic_write)
        ask_write(of, of.next_write);
    return true;
}

// A refusal of more than a route's registers may be meant for the others.
void client_line::heard_refusal(std::size_t station, const station_question& asked, const station_refusal& why)
{
    const auto read = read_in(asked);
    const auto written = written_in(asked);
    for (row& each : routes_) {
        const route& r = each.content;
        const bool refused_read =
            read && each.station == station && reads(r.way) && covers(r.there, r.count, read->first, read->count);
        const bool refused_write =
            written && each.station == station && writes(r.way) &&
            covers(r.there, r.count, written->first, static_cast<std::uint32_t>(written->values.size()));
        if (!refused_read && !refused_write)
            continue;
        ++reading_row(each).content.errors;
        set_quality(each, quality::device_error, why.reason, why.code);
    }
}

// Whoever asks repeats its question before it thinks ill of a healthy station, and so do we.
void client_line::heard_silence(std::size_t station, const station_question& asked, time_point now)
{
    const health before = schedule_.state_of(station);
    if (before == health::healthy && ++unanswered_[station] <= stations_[station].timing.retries)
        return;
    schedule_.overheard(station, schedule::outcome::silent, now);
    const boost::system::error_code why = make_error_code(errc::timed_out);
    const std::string reason = reason_of(asked, why);
    const auto code = static_cast<std::uint16_t>(code_of(why));
    const auto read = read_in(asked);
    for (row& each : routes_) {
        const route& r = each.content;
        if (!read || each.station != station || !reads(r.way) || !overlap(read->first, read->count, r.there, r.count))
            continue;
        ++each.content.errors;
        set_quality(each, quality::comm_error, reason, code);
    }
    note_health(station, before, reason, code);
}

}  // namespace plcgw
