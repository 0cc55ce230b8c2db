#include "bridge/routes/client_line.hpp"

#include "bridge/routes/route_status.hpp"
#include "bridge/services/mewtocol_forward.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration least_longest_delay = std::chrono::seconds(5);

std::vector<read_settings> reads_of(const std::vector<station>& stations)
{
    std::vector<read_settings> all;
    for (const station& each : stations)
        all.push_back(each.reads);
    return all;
}

}  // namespace

client_line::client_line(std::string name, std::vector<station> stations, const line_options& options)
    : name_(std::move(name)), options_(options), stations_(std::move(stations)), times_(stations_.size()),
      statistics_(stations_.size()), polls_(reads_of(stations_)), schedule_(stations_.size()),
      forwards_(options.cache_age)
{
    schedule_.set_parallel(options.parallel);
    if (options.numbered_answers)
        schedule_.set_numbered_answers();
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        const modbus::serial_options& each = stations_[i].timing;
        schedule_.set_longest_delay(i, std::max(least_longest_delay, (each.retries + 2) * each.response_timeout));
    }
}

void client_line::plan()
{
    if (!std::exchange(planned_, true))
        polls_.plan(schedule_);
}

std::optional<client_line::question> client_line::next(time_point now)
{
    const auto verdict = [&](const forward_request& each) { return verdict_of(each, now); };
    forwards_wake_ = forwards_.empty() ? time_point::max() : forwards_.look(now, verdict);
    forwards_came_ = false;
    offer_scan(now);
    auto turn = schedule_.next(now, forwards_wake_ <= now);
    while (turn && is_idle(*turn)) {
        schedule_.pass(*turn, now);
        turn = schedule_.next(now, forwards_wake_ <= now);
    }
    if (!turn)
        return std::nullopt;
    if (turn->of == lane::scan)
        return next_scan(now);
    std::optional<question> chosen;
    if (turn->of == lane::forward)
        chosen = next_forward(now);
    else
        chosen = question_of_turn(*turn, now);
    if (turn->of != lane::forward && polls_.at(turn->item).period == duration{}) {
        row& of = routes_[polls_.at(turn->item).routes.front()];
        of.on_its_way = std::exchange(of.waiting, {});
        if (turn->is_wanted) {
            of.heard_written.clear();
            of.first_write.reset();
            of.taken_back.reset();
        }
    }
    if (chosen)
        chosen->timing.delimiter = delimiter_of(chosen->unit, chosen->timing.delimiter);
    return chosen;
}

// A poll that is not needed now lets its turn pass, unless the station's health waits for it.
bool client_line::is_idle(const schedule::turn& turn) const
{
    return turn.of != lane::forward && turn.of != lane::scan && !polls_.is_needed(turn.item) &&
           schedule_.state_of(polls_.at(turn.item).station) == health::healthy;
}

std::size_t client_line::station_of(station_number unit)
{
    const auto found =
        std::find_if(stations_.begin(), stations_.end(), [unit](const station& each) { return each.unit == unit; });
    if (found != stations_.end())
        return static_cast<std::size_t>(found - stations_.begin());
    stations_.push_back({{}, unit, options_.timing});
    times_.emplace_back();
    return schedule_.add_station();
}

modbus::serial_options client_line::timing_of(std::size_t station) const
{
    modbus::serial_options timing = stations_[station].timing;
    const auto& shortest = stations_[station].shortest_timeout;
    // Who was silent once gets the whole time: it may just have been slower than ever.
    if (shortest && schedule_.state_of(station) != health::suspect)
        timing.response_timeout = times_[station].timeout(*shortest, timing.response_timeout);
    return timing;
}

client_line::question client_line::question_of_turn(const schedule::turn& turn, time_point now) const
{
    const line_polls::item& chosen = polls_.at(turn.item);
    const bool is_read = chosen.period != duration{};
    question q{turn,
               stations_[chosen.station].unit,
               is_read ? read_question(chosen.first, chosen.count)
                       : write_or_probe(routes_[chosen.routes.front()], turn.is_wanted),
               timing_of(chosen.station),
               now,
               chosen};
    if (!turn.with_retries)
        q.timing.retries = 0;
    return q;
}

void client_line::answered(const question& q, const station_answer& answer, time_point now, wall_time wall,
                           unanswered_requests late, std::optional<duration> response_time)
{
    if (std::holds_alternative<scan_ticket>(q.origin)) {
        if (station_scan* const scan = scan_of(q, now))
            scan->answered(answer);
        return;
    }
    learn_delimiter(q, answer);
    const std::size_t station = station_of(q.unit);
    const health before = schedule_.state_of(station);
    if (response_time && late.count == 0)
        times_[station].add(*response_time);
    const auto refusal = refusal_in(answer);
    statistics_.answered(station, refusal ? &refusal->reason : nullptr, wall);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        schedule_.forwarded(station, schedule::outcome::answered, now - q.asked_at, now, late, {});
        note_health(station, before, {});
        forwards_.answer(*forwarded, std::get<modbus::response>(answer), now);
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    schedule_.finished(turn, schedule::outcome::answered, now - q.asked_at, now, late);
    note_health(station, before, {});
    note_load(now);
    if (q.item.period == duration{})
        forwards_.forget(q.unit, now);
    else if (const auto* const response = std::get_if<modbus::response>(&answer))
        forwards_.heard(q.unit, q.request(), *response, q.asked_at, now);
    if (!turn.is_wanted)
        return;  // the probe of a station: its values are nobody's
    for (const std::size_t each : q.item.routes)
        routes_[each].answered = true;
    if (refusal)
        refused(q, *refusal, now, wall);
    else
        served(q, answer, now, wall);
}

void client_line::refused(const question& q, const station_refusal& why, time_point now, wall_time wall)
{
    const bool is_write = q.item.period == duration{};
    line_polls::lesson lesson{true, {}};
    if (!is_write)
        lesson = polls_.refused(q.item, why, wall, now, schedule_);
    if (!lesson.text.empty())
        note(line_event::severity::warning, "device.limit", subject_of(stations_[q.item.station]),
             label(stations_[q.item.station]) + " " + lesson.text);
    for (const std::size_t each : q.item.routes) {
        if (!lesson.blames_routes)
            break;
        ++reading_row(routes_[each]).content.errors;
        set_quality(routes_[each], quality::device_error, why.reason, why.code);
    }
    if (!is_write)
        return;
    row& of = routes_[q.item.routes.front()];
    const bool somebody_waits = !of.on_its_way.empty();
    through_refused(of, q, why);
    if (!of.through || !somebody_waits)
        was_refused(of, q, now, why.may_pass);
}

// All that one answer brings is of one moment.
void client_line::served(const question& q, const station_answer& answer, time_point now, wall_time wall)
{
    for (const std::size_t each : q.item.routes)
        bring(routes_[each], q, answer, now, wall);
    if (q.item.period != duration{})
        polls_.accepted(q.item, wall, now, schedule_);
}

void client_line::bring(row& of, const question& q, const station_answer& answer, time_point now, wall_time wall)
{
    const bool is_read = q.item.period != duration{};
    if (!is_outdated(of, q)) {
        const std::vector<std::uint16_t> words_before = of.content.words;
        const std::size_t offset = is_read ? number(of.content.there) - number(q.item.first) : 0;
        store(of.content, q.asked, is_read ? part_of(answer, offset, of.content.count) : answer);
        was_stored(of, q, now);
        of.changed = of.changed || of.content.words != words_before;
    }
    of.content.source = wall;
    of.good_at = now;
    if (is_read)
        statistics_.was_read(of.station, index_of(of), now);
    ++of.content.answers;
    set_quality(of, quality::good, {});
}

void client_line::responded(const question& q, duration after)
{
    if (std::holds_alternative<scan_ticket>(q.origin))
        return;
    const std::size_t station = station_of(q.unit);
    if (!stations_[station].name.empty())
        polls_.responded(station, q.asked, after);
}

void client_line::failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late)
{
    if (std::holds_alternative<scan_ticket>(q.origin)) {
        if (station_scan* const scan = scan_of(q, now))
            scan->failed(why);
        return;
    }
    doubt_delimiter(q.unit);
    const std::size_t station = station_of(q.unit);
    const health before = schedule_.state_of(station);
    const bool asked = why != errc::line_not_quiet && why != errc::not_expressible;
    const auto how = asked ? schedule::outcome::silent : schedule::outcome::not_asked;
    const std::string reason = reason_of(q.asked, why);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        // What comes late then would answer another question to this station.
        const duration pause = late.count != 0 ? q.timing.response_timeout : duration{};
        schedule_.forwarded(station, how, now - q.asked_at, now, late, pause);
        note_health(station, before, reason);
        forwards_.answer(*forwarded, why, now);
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    const auto code = static_cast<std::uint16_t>(code_of(why));
    schedule_.finished(turn, how, now - q.asked_at, now, late);
    const bool is_write = q.item.period == duration{};
    if (is_write)
        forwards_.forget(q.unit, now);
    for (const std::size_t each : q.item.routes) {
        ++reading_row(routes_[each]).content.errors;
        set_quality(routes_[each], quality::comm_error, reason, code);
    }
    note_health(station, before, reason, code);
    if (!is_write)
        return;
    through_unanswered(routes_[q.item.routes.front()], reason);
    if (late.count != 0 && !schedule_.is_wanted(turn.item))  // what comes late must not meet another question
        schedule_.keep_quiet(station, now + q.timing.response_timeout);
}

void client_line::interrupted(const question& q)
{
    if (std::holds_alternative<scan_ticket>(q.origin)) {
        if (station_scan* const scan = scan_of(q, q.asked_at))
            scan->interrupted();
    }
    else if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        forwards_.answer(*forwarded, make_error_code(errc::port_absent), q.asked_at);
    }
    else {
        const auto& turn = std::get<schedule::turn>(q.origin);
        schedule_.finished(turn, schedule::outcome::not_asked, {}, q.asked_at);
        if (q.item.period == duration{})
            through_lost(routes_[q.item.routes.front()]);
    }
}

void client_line::port_lost(const std::string& why)
{
    for (row& each : routes_)
        through_lost(each);
    for (row& each : routes_)
        lose(each, why, static_cast<std::uint16_t>(no_answer::no_port));
    forwards_.answer_all(errc::port_absent);
    statistics_.port_lost(why);
    port_open_ = false;
}

void client_line::set_quality(row& of, quality state, const std::string& reason, std::uint16_t code)
{
    route& r = of.content;
    if (r.state == quality::substituted && state == quality::comm_error)
        state = r.state;  // still lost
    if (state == quality::device_error && (r.state != state || r.reason != reason))
        note(line_event::severity::warning, "route.refused", r.name,
             "line " + name_ + ", route " + r.name + ": " + label(stations_[of.station]) + " refuses: " + reason);
    if (r.state == quality::device_error && state == quality::good)
        note(line_event::severity::info, "route.accepted", r.name,
             "line " + name_ + ", route " + r.name + ": accepted again");
    of.changed = of.changed || r.state != state;
    r.state = state;
    r.reason = reason;
    r.reason_code = code;
}

void client_line::note_health(std::size_t index, health before, const std::string& reason, std::uint16_t code)
{
    const station& of = stations_[index];
    const health after = schedule_.state_of(index);
    statistics_.is(index, after, reason);
    if (before == health::down && after == health::healthy)
        note(line_event::severity::info, "device.up", subject_of(of), label(of) + " answers again");
    if (before == health::down || after != health::down)
        return;
    bool has_routes = false;
    bool replaced = false;
    for (row& each : routes_) {
        if (each.station != index)
            continue;
        has_routes = true;
        lose(each, reason, code);
        if (!each.waiting.empty() && each.on_its_way.empty())  // else what is out tells those who wait, too
            through_unanswered(each, reason);
        replaced = replaced || each.content.state == quality::substituted;
    }
    const std::string values = replaced ? "kept or replaced as on_loss says" : "kept";
    note(line_event::severity::warning, "device.down", subject_of(of),
         label(of) + " does not answer (" + reason + "): " +
             (has_routes ? "its values are " + values + ", it is probed from now on"
                         : "requests to it fail at once, until one that is let through now and then is answered"));
}

std::string client_line::subject_of(const station& of) const
{
    return of.name.empty() ? name_ + ", unit " + std::to_string(number(of.unit)) : of.name;
}

std::string client_line::label(const station& of) const
{
    const std::string unit = "unit " + std::to_string(number(of.unit));
    return "line " + name_ + ", " + (of.name.empty() ? unit : "station " + of.name + " (" + unit + ")");
}

}  // namespace plcgw
