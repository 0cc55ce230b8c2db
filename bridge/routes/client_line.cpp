#include "bridge/routes/client_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int periods_until_stale = 3;
constexpr duration least_longest_delay = std::chrono::seconds(5);
constexpr duration refused_write_pause = std::chrono::seconds(1);

std::vector<reading> readings_of(const std::vector<station>& stations)
{
    std::vector<reading> readings;
    for (const station& each : stations)
        readings.push_back(each.reads);
    return readings;
}

}  // namespace

client_line::client_line(std::string name, std::vector<station> stations, duration longest_silence,
                         const modbus::serial_options& timing)
    : name_(std::move(name)), stations_(std::move(stations)), polls_(readings_of(stations_)),
      schedule_(stations_.size()), timing_(timing), longest_silence_(longest_silence)
{
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        const modbus::serial_options& each = stations_[i].timing;
        schedule_.set_longest_delay(i, std::max(least_longest_delay, (each.retries + 2) * each.response_timeout));
    }
}

void client_line::add_route(route r, std::size_t station, duration period)
{
    if (r.way == direction::read)
        polls_.add_read(station, {r.there, r.count, period});
    else
        polls_.add_write(station);
    r.words.resize((bits_of(r) + 15) / 16);
    row& added = routes_.emplace_back();
    added.content = std::move(r);
    added.station = station;
    added.period = period;
}

void client_line::plan()
{
    if (!std::exchange(planned_, true))
        polls_.plan(schedule_);
}

std::optional<forward_ticket> client_line::forward(station_number unit, modbus::request request,
                                                   std::optional<modbus::serial_options> timing)
{
    const auto ticket = forwards_.add(unit, std::move(request), std::move(timing));
    if (!port_open_)
        forwards_.answer_all(errc::port_absent);
    return ticket;
}

// Forwarded requests and routes take turns when both want the line.
std::optional<client_line::question> client_line::next(time_point now)
{
    std::optional<question> chosen;
    if (!forwarded_last_)
        chosen = next_forward(now);
    if (!chosen)
        chosen = next_poll(now);
    if (!chosen)
        chosen = next_forward(now);
    forwarded_last_ = chosen && std::holds_alternative<forward_ticket>(chosen->origin);
    if (chosen)
        chosen->timing.delimiter = delimiter_of(chosen->unit, chosen->timing.delimiter);
    return chosen;
}

std::optional<client_line::question> client_line::next_forward(time_point now)
{
    while (!forwards_.empty()) {
        forward_request first = forwards_.take();
        const station* const of = find(first.unit);
        if (of != nullptr && schedule_.state_of(static_cast<std::size_t>(of - stations_.data())) == health::down) {
            forwards_.answer(first.ticket, make_error_code(errc::timed_out));  // at once: the line is for the living
            continue;
        }
        const modbus::serial_options& timing = first.timing ? *first.timing : of != nullptr ? of->timing : timing_;
        return question{first.ticket, first.unit, std::move(first.request), timing, now};
    }
    return std::nullopt;
}

std::uint8_t client_line::delimiter_of(station_number unit, std::uint8_t of_a_stranger) const
{
    const auto told = delimiters_.find(unit);
    if (told == delimiters_.end())
        return of_a_stranger;
    return told->second.in_force ? told->second.character : modbus::ascii_delimiter;
}

void client_line::learn_delimiter(const question& q, const station_answer& answer)
{
    const auto* const response = std::get_if<modbus::response>(&answer);
    const auto* const request = std::get_if<modbus::request>(&q.asked);
    const auto* const asked = request == nullptr ? nullptr : std::get_if<modbus::diagnostics>(request);
    if (asked == nullptr || response == nullptr || asked->what != modbus::diagnostic::change_ascii_delimiter ||
        asked->data.empty())
        return;
    if (std::holds_alternative<modbus::diagnostics_answered>(*response))
        delimiters_[q.unit] = {asked->data[0]};
    else if (q.unit == station_number(modbus::unit_id::broadcast) &&
             std::holds_alternative<modbus::no_response>(*response))
        for (unsigned unit = 0; unit <= 247; ++unit)  // whoever did not hear it is found out by asking
            delimiters_[station_number(unit)] = {asked->data[0]};
}

void client_line::doubt_delimiter(station_number unit)
{
    if (const auto told = delimiters_.find(unit); told != delimiters_.end())
        told->second.in_force = !told->second.in_force;
}

const station* client_line::find(station_number unit) const
{
    const auto found =
        std::find_if(stations_.begin(), stations_.end(), [unit](const station& each) { return each.unit == unit; });
    return found == stations_.end() ? nullptr : &*found;
}

std::optional<client_line::question> client_line::next_poll(time_point now)
{
    auto turn = schedule_.next(now);
    // A poll that is not needed now lets its turn pass, unless the station's health waits for it.
    for (; turn && !polls_.is_needed(turn->item); turn = schedule_.next(now)) {
        if (schedule_.state_of(polls_.at(turn->item).station) != health::healthy)
            break;
        schedule_.finished(*turn, schedule::outcome::not_asked, {}, now);
    }
    if (!turn)
        return std::nullopt;
    const line_polls::item& chosen = polls_.at(turn->item);
    const station& of = stations_[chosen.station];
    const bool reads = chosen.period != duration{};
    question q{*turn,
               of.unit,
               reads ? read_question(chosen.first, chosen.count) : question_of(routes_[chosen.routes.front()].content),
               of.timing,
               now,
               chosen};
    if (!turn->with_retries)
        q.timing.retries = 0;
    return q;
}

bool client_line::attempt_failed(const question& q, const modbus::answer_fault& why)
{
    const auto* const forwarded = std::get_if<forward_ticket>(&q.origin);
    if (forwarded != nullptr)
        forwards_.note_fault(*forwarded, why);
    return forwarded != nullptr;
}

void client_line::answered(const question& q, const station_answer& answer, time_point now, wall_time wall,
                           unanswered_requests late)
{
    learn_delimiter(q, answer);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        forwards_.answer(*forwarded, std::get<modbus::response>(answer));
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    const std::size_t station = q.item.station;
    const health before = schedule_.state_of(station);
    schedule_.finished(turn, schedule::outcome::answered, now - q.asked_at, now, late);
    if (before == health::down)
        note(line_event::severity::info, label(stations_[station]) + " answers again");
    for (const std::size_t each : q.item.routes)
        routes_[each].answered = true;
    if (const auto why = refusal_in(answer))
        refused(q, *why, now, wall);
    else
        served(q, answer, now, wall);
}

void client_line::refused(const question& q, const station_refusal& why, time_point now, wall_time wall)
{
    const bool writes = q.item.period == duration{};
    line_polls::lesson lesson{true, {}};
    if (!writes)
        lesson = polls_.refused(q.item, why, wall, now, schedule_);
    if (!lesson.text.empty())
        note(line_event::severity::warning, label(stations_[q.item.station]) + " " + lesson.text);
    if (lesson.blames_routes)
        for (const std::size_t each : q.item.routes)
            set_quality(routes_[each], quality::device_error, why.reason);
    if (writes && why.may_pass)
        schedule_.ask(std::get<schedule::turn>(q.origin).item, now + refused_write_pause);
}

// All that one answer brings is of one moment.
void client_line::served(const question& q, const station_answer& answer, time_point now, wall_time wall)
{
    const bool reads = q.item.period != duration{};
    for (const std::size_t each : q.item.routes) {
        row& of = routes_[each];
        const std::vector<std::uint16_t> words_before = of.content.words;
        if (reads)
            store(of.content, q.asked,
                  part_of(answer, number(of.content.there) - number(q.item.first), of.content.count));
        else
            store(of.content, q.asked, answer);
        of.content.source = wall;
        of.good_at = now;
        of.changed = of.changed || of.content.words != words_before;
        set_quality(of, quality::good, {});
    }
    if (reads)
        polls_.accepted(q.item, wall, now, schedule_);
}

void client_line::responded(const question& q, duration after)
{
    const station* const of = find(q.unit);
    if (of != nullptr)
        polls_.responded(static_cast<std::size_t>(of - stations_.data()), q.request(), after);
}

void client_line::failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late)
{
    doubt_delimiter(q.unit);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        forwards_.answer(*forwarded, why);
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    const std::size_t station = q.item.station;
    const health before = schedule_.state_of(station);
    const bool asked = why != errc::line_not_quiet;
    schedule_.finished(turn, asked ? schedule::outcome::silent : schedule::outcome::not_asked, now - q.asked_at, now,
                       late);
    const std::string reason = reason_of(q.asked, why);
    for (const std::size_t each : q.item.routes)
        set_quality(routes_[each], quality::comm_error, reason);
    if (before != health::down && schedule_.state_of(station) == health::down)
        station_down(station, reason);
}

void client_line::interrupted(const question& q)
{
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin))
        forwards_.answer(*forwarded, make_error_code(errc::port_absent));
    else
        schedule_.finished(std::get<schedule::turn>(q.origin), schedule::outcome::not_asked, {}, q.asked_at);
}

void client_line::port_lost(const std::string& why)
{
    for (row& each : routes_)
        lose(each, why);
    forwards_.answer_all(errc::port_absent);
    port_open_ = false;
}

// A value that nobody can renew now. What is only written is as good as it was.
void client_line::lose(row& of, const std::string& why)
{
    if (of.content.way == direction::read)
        set_quality(of, quality::comm_error, why);
}

bool client_line::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    plan();
    bool due = false;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
        if (routes_[i].content.way != direction::write || !touches(routes_[i].content, plc, changed))
            continue;
        schedule_.ask(polls_.item_of_write(i));
        due = true;
    }
    return due;
}

std::vector<sample> client_line::take_samples(time_point now)
{
    std::vector<sample> samples;
    for (row& each : routes_) {
        age(each, now);
        const bool confirmed = each.answered && now - each.said_at >= longest_silence_;
        if (!each.changed && !confirmed)
            continue;
        each.changed = each.answered = false;
        each.said_at = now;
        samples.push_back(sample_of(each.content));
    }
    return samples;
}

// A value that is not renewed although its station answers, because the line is overloaded.
void client_line::age(row& of, time_point now)
{
    const bool polled = of.content.way == direction::read;
    if (polled && of.content.state == quality::good && now - of.good_at > periods_until_stale * of.period)
        set_quality(of, quality::stale, "not read for more than " + std::to_string(periods_until_stale) + " periods");
}

void client_line::say_everything()
{
    for (row& each : routes_)
        each.changed = true;
}

std::size_t client_line::routes_up() const
{
    return static_cast<std::size_t>(std::count_if(routes_.begin(), routes_.end(), [](const row& each) {
        const bool idle_write = each.content.way == direction::write && each.content.state == quality::never_read;
        return each.content.state == quality::good || idle_write;
    }));
}

void client_line::worsen(sample& of, const plc::simulated_plc& plc, plc::place at, std::size_t bits) const
{
    const plc::change span{at.area, at.bit, bits};
    for (const row& each : routes_) {
        if (each.content.way != direction::read || !touches(each.content, plc, span))
            continue;
        if (each.content.state != quality::good && of.state == quality::good)
            of.state = each.content.state;
        of.source = std::min(of.source, each.content.source);
    }
}

void client_line::set_quality(row& of, quality state, const std::string& reason)
{
    route& r = of.content;
    if (state == quality::device_error && (r.state != state || r.reason != reason))
        note(line_event::severity::warning,
             "line " + name_ + ", route " + r.name + ": " + label(stations_[of.station]) + " refuses: " + reason);
    if (r.state == quality::device_error && state == quality::good)
        note(line_event::severity::info, "line " + name_ + ", route " + r.name + ": accepted again");
    of.changed = of.changed || r.state != state;
    r.state = state;
    r.reason = reason;
}

void client_line::station_down(std::size_t index, const std::string& reason)
{
    note(line_event::severity::warning,
         label(stations_[index]) + " does not answer (" + reason + "): its values are kept, it is probed from now on");
    for (row& each : routes_)
        if (each.station == index)
            lose(each, reason);
}

std::string client_line::label(const station& of) const
{
    return "line " + name_ + ", station " + of.name + " (unit " + std::to_string(number(of.unit)) + ")";
}

}  // namespace plcgw
