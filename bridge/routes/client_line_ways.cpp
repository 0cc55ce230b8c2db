// Which way values go on a client line: what each direction does with a change, an answer, a refusal and a loss.
#include "bridge/routes/client_line.hpp"

namespace plcgw {
namespace {

constexpr duration refused_write_pause = std::chrono::seconds(1);

}  // namespace

std::size_t client_line::add_route(route r, std::size_t station, duration period)
{
    const std::size_t index = routes_.size();
    const bool both = r.way == direction::read_write;
    if (both)
        r.way = direction::read;
    if (reads(r.way)) {
        polls_.add_read(station, {r.there, r.count, period});
        statistics_.add_read(station, index, period);
    }
    else
        polls_.add_write(station);
    r.words.resize((bits_of(r) + 15) / 16);
    row& added = routes_.emplace_back();
    added.station = station;
    added.period = period;
    if (r.way == direction::periodic_write)
        added.first_write = r.plc->memory().watch_writes(r.at, bits_of(r));
    if (r.way == direction::write_through) {
        added.through = r.plc->memory().watch_writes(r.at, bits_of(r));
        added.agreed = words_in_memory(r);
    }
    added.content = std::move(r);
    if (!both)
        return index;

    route writing = added.content;
    writing.way = direction::write;
    added.agreed = words_in_memory(writing);
    const std::size_t half = add_route(std::move(writing), station, {});
    routes_[index].partner = half;
    routes_[half].partner = index;
    routes_[half].half = true;
    ++halves_;
    return index;
}

// Somebody changed the memory of a route that reads and writes, and the station does not have that yet.
bool client_line::is_to_be_written(const row& of) const
{
    if (!of.partner || of.half)
        return false;
    // A write that is under way may change the station yet, even if the memory is again as it was.
    return is_write_due(routes_[*of.partner]) ||
           (of.content.plc->memory().has_changes() && words_in_memory(of.content) != of.agreed);
}

void client_line::read_soon(const row& of, time_point now) { schedule_.ask(polls_.item_of_read(index_of(of)), now); }

// A read that must not undo what somebody wrote meanwhile.
bool client_line::is_outdated(const row& of, const question& q) const
{
    return (of.partner && !of.half && q.asked_at < of.written_at) || is_to_be_written(of);
}

void client_line::was_stored(row& of, const question& q, time_point now)
{
    if (of.content.way == direction::periodic_write)
        plan_next_write(of, q, now, words_in_memory(of.content) != of.content.words);
    if (of.through)
        of.agreed = of.content.words;
    through_ended(of, std::nullopt);
    if (!of.partner)
        return;
    row& read = reading_row(of);
    read.agreed = of.half ? of.content.words : words_in_memory(of.content);
    if (!of.half)
        return;
    read.written_at = now;
    read_soon(read, now);  // what the station made of it is read back
}

void client_line::was_refused(row& of, const question& q, time_point now, bool may_pass)
{
    if (may_pass)
        ask_write(of, now + refused_write_pause);
    else if (of.content.way == direction::periodic_write)
        plan_next_write(of, q, now, false);
    else if (of.half)  // the next read brings back what the station has
        reading_row(of).agreed = words_in_memory(of.content);
}

// is_due: the devices changed since the question was asked, and that is to be written at once.
void client_line::plan_next_write(row& of, const question& q, time_point now, bool is_due)
{
    if (of.next_write <= q.asked_at)
        of.next_write += of.period;
    if (of.next_write <= now)
        of.next_write = now + of.period;
    if (!is_due)
        ask_write(of, of.next_write);
}

// A station that is only written to is probed by a read: what the memory holds now nobody may have written.
station_question client_line::write_or_probe(const row& of, bool is_wanted)
{
    return is_wanted ? question_of(of.content) : read_question(of.content.there, of.content.count);
}

// A value that nobody can renew now. What is only written is as good as it was.
void client_line::lose(row& of, const std::string& why, std::uint16_t code)
{
    route& r = of.content;
    if (!reads(r.way))
        return;
    if (r.substitute.empty() || is_to_be_written(of)) {
        set_quality(of, quality::comm_error, why, code);
        return;
    }
    show_substitute(r);
    of.agreed = words_in_memory(r);
    set_quality(of, quality::substituted, why, code);
}

bool client_line::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    plan();
    bool due = false;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
        row& of = routes_[i];
        if (!writes(of.content.way) || !touches(of.content, plc, changed))
            continue;
        // Another value may be on its way to the station: then what it had before is to be written, too.
        const bool is_new = is_write_due(of) || words_in_memory(of.content) != reading_row(of).agreed;
        if ((of.half || of.through) && !is_new)
            continue;  // it came from the station, or a write that failed was taken back
        if (was_heard_written(of))
            continue;
        if (of.taken_back && words_in_memory(of.content) == *of.taken_back)
            continue;
        of.taken_back.reset();
        if (of.waiting.empty())
            of.first_write.reset();
        ask_write(of);
        due = true;
    }
    return due;
}

bool client_line::memory_written()
{
    plan();
    bool due = false;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
        row& of = routes_[i];
        if (of.through)
            of.content.plc->memory().take_written(*of.through);  // not by a client who waits
        if (!of.first_write || !of.content.plc->memory().take_written(*of.first_write))
            continue;
        of.first_write.reset();
        ask_write(of);
        due = true;
    }
    return due;
}

}  // namespace plcgw
