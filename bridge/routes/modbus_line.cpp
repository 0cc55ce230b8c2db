#include "bridge/routes/modbus_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int periods_until_stale = 3;
constexpr duration least_longest_delay = std::chrono::seconds(5);
constexpr duration refused_write_pause = std::chrono::seconds(1);

// Exceptions that say "not now" rather than "never".
bool may_pass(modbus::exception_code code)
{
    return code == modbus::exception_code::acknowledge || code == modbus::exception_code::server_device_busy;
}

std::string exception_text(modbus::exception_code code)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto value = static_cast<unsigned>(code);
    return std::string("exception ") + digits[value / 16 % 16] + digits[value % 16] + " (" +
           std::string(modbus::to_string(code)) + ")";
}

}  // namespace

modbus_line::modbus_line(std::string name, std::vector<station> stations, duration longest_silence,
                         const modbus::serial_options& timing)
    : name_(std::move(name)), stations_(std::move(stations)), schedule_(stations_.size()), timing_(timing),
      longest_silence_(longest_silence)
{
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        const modbus::serial_options& each = stations_[i].timing;
        schedule_.set_longest_delay(i, std::max(least_longest_delay, (each.retries + 2) * each.response_timeout));
    }
}

void modbus_line::add_route(route r, std::size_t station, duration period)
{
    if (r.way == direction::read)
        schedule_.add_poll(station, period);
    else
        schedule_.add_write(station);
    r.words.resize((bits_of(r) + 15) / 16);
    row& added = routes_.emplace_back();
    added.content = std::move(r);
    added.station = station;
    added.period = period;
}

std::optional<forward_ticket> modbus_line::forward(modbus::unit_id unit, modbus::request request,
                                                   std::optional<modbus::serial_options> timing)
{
    const auto ticket = forwards_.add(unit, std::move(request), std::move(timing));
    if (!port_open_)
        forwards_.answer_all(errc::port_absent);
    return ticket;
}

// Forwarded requests and routes take turns when both want the line.
std::optional<modbus_line::question> modbus_line::next(time_point now)
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

std::optional<modbus_line::question> modbus_line::next_forward(time_point now)
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

std::uint8_t modbus_line::delimiter_of(modbus::unit_id unit, std::uint8_t of_a_stranger) const
{
    const auto told = delimiters_.find(unit);
    if (told == delimiters_.end())
        return of_a_stranger;
    return told->second.in_force ? told->second.character : modbus::ascii_delimiter;
}

void modbus_line::learn_delimiter(const question& q, const modbus::response& answer)
{
    const auto* const asked = std::get_if<modbus::diagnostics>(&q.request);
    if (asked == nullptr || asked->what != modbus::diagnostic::change_ascii_delimiter || asked->data.empty())
        return;
    if (std::holds_alternative<modbus::diagnostics_answered>(answer))
        delimiters_[q.unit] = {asked->data[0]};
    else if (q.unit == modbus::unit_id::broadcast && std::holds_alternative<modbus::no_response>(answer))
        for (unsigned unit = 0; unit <= 247; ++unit)  // whoever did not hear it is found out by asking
            delimiters_[modbus::unit_id{static_cast<std::uint8_t>(unit)}] = {asked->data[0]};
}

void modbus_line::doubt_delimiter(modbus::unit_id unit)
{
    if (const auto told = delimiters_.find(unit); told != delimiters_.end())
        told->second.in_force = !told->second.in_force;
}

const station* modbus_line::find(modbus::unit_id unit) const
{
    const auto found =
        std::find_if(stations_.begin(), stations_.end(), [unit](const station& each) { return each.unit == unit; });
    return found == stations_.end() ? nullptr : &*found;
}

std::optional<modbus_line::question> modbus_line::next_poll(time_point now)
{
    const auto turn = schedule_.next(now);
    if (!turn)
        return std::nullopt;
    const row& chosen = routes_[turn->item];
    const station& of = stations_[chosen.station];
    question q{*turn, of.unit, question_of(chosen.content), of.timing, now};
    if (!turn->with_retries)
        q.timing.retries = 0;
    return q;
}

bool modbus_line::attempt_failed(const question& q, const modbus::answer_fault& why)
{
    const auto* const forwarded = std::get_if<forward_ticket>(&q.origin);
    if (forwarded != nullptr)
        forwards_.note_fault(*forwarded, why);
    return forwarded != nullptr;
}

void modbus_line::answered(const question& q, const modbus::response& answer, time_point now, wall_time wall,
                           unanswered_requests late)
{
    learn_delimiter(q, answer);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        forwards_.answer(*forwarded, answer);
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    row& of = routes_[turn.item];
    const health before = schedule_.state_of(of.station);
    schedule_.finished(turn, schedule::outcome::answered, now - q.asked_at, now, late);
    if (before == health::down)
        note(line_event::severity::info, label(stations_[of.station]) + " answers again");

    of.answered = true;
    if (const auto* refused = std::get_if<modbus::exception_code>(&answer)) {
        set_quality(of, quality::device_error, exception_text(*refused));
        if (of.content.way == direction::write && may_pass(*refused))
            schedule_.ask(turn.item, now + refused_write_pause);
        return;
    }
    const std::vector<std::uint16_t> words_before = of.content.words;
    store(of.content, q.request, answer);
    of.content.source = wall;
    of.good_at = now;
    of.changed = of.changed || of.content.words != words_before;
    set_quality(of, quality::good, {});
}

void modbus_line::failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late)
{
    doubt_delimiter(q.unit);
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin)) {
        forwards_.answer(*forwarded, why);
        return;
    }
    const auto& turn = std::get<schedule::turn>(q.origin);
    row& of = routes_[turn.item];
    const health before = schedule_.state_of(of.station);
    const bool asked = why != errc::line_not_quiet;
    schedule_.finished(turn, asked ? schedule::outcome::silent : schedule::outcome::not_asked, now - q.asked_at, now,
                       late);
    set_quality(of, quality::comm_error, why.message());
    if (before != health::down && schedule_.state_of(of.station) == health::down)
        station_down(of.station, why.message());
}

void modbus_line::interrupted(const question& q)
{
    if (const auto* forwarded = std::get_if<forward_ticket>(&q.origin))
        forwards_.answer(*forwarded, make_error_code(errc::port_absent));
    else
        schedule_.finished(std::get<schedule::turn>(q.origin), schedule::outcome::not_asked, {}, q.asked_at);
}

void modbus_line::port_lost(const std::string& why)
{
    for (row& each : routes_)
        lose(each, why);
    forwards_.answer_all(errc::port_absent);
    port_open_ = false;
}

// A value that nobody can renew now. What is only written is as good as it was.
void modbus_line::lose(row& of, const std::string& why)
{
    if (of.content.way == direction::read)
        set_quality(of, quality::comm_error, why);
}

bool modbus_line::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    bool due = false;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
        if (routes_[i].content.way != direction::write || !touches(routes_[i].content, plc, changed))
            continue;
        schedule_.ask(i);
        due = true;
    }
    return due;
}

std::vector<sample> modbus_line::take_samples(time_point now)
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
void modbus_line::age(row& of, time_point now)
{
    const bool polled = of.content.way == direction::read;
    if (polled && of.content.state == quality::good && now - of.good_at > periods_until_stale * of.period)
        set_quality(of, quality::stale, "not read for more than " + std::to_string(periods_until_stale) + " periods");
}

void modbus_line::say_everything()
{
    for (row& each : routes_)
        each.changed = true;
}

std::size_t modbus_line::routes_up() const
{
    return static_cast<std::size_t>(std::count_if(routes_.begin(), routes_.end(), [](const row& each) {
        const bool idle_write = each.content.way == direction::write && each.content.state == quality::never_read;
        return each.content.state == quality::good || idle_write;
    }));
}

void modbus_line::worsen(sample& of, const plc::simulated_plc& plc, plc::place at, std::size_t bits) const
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

void modbus_line::set_quality(row& of, quality state, const std::string& reason)
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

void modbus_line::station_down(std::size_t index, const std::string& reason)
{
    note(line_event::severity::warning,
         label(stations_[index]) + " does not answer (" + reason + "): its values are kept, it is probed from now on");
    for (row& each : routes_)
        if (each.station == index)
            lose(each, reason);
}

std::string modbus_line::label(const station& of) const
{
    return "line " + name_ + ", station " + of.name + " (unit " + std::to_string(modbus::number(of.unit)) + ")";
}

}  // namespace plcgw
