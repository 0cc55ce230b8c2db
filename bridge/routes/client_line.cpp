#include "bridge/routes/client_line.hpp"

#include "bridge/routes/route_status.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int periods_until_stale = 3;
constexpr duration least_longest_delay = std::chrono::seconds(5);

}  // namespace

client_line::client_line(std::string name, std::vector<station> stations, duration longest_silence,
                         const modbus::serial_options& timing)
    : name_(std::move(name)), stations_(std::move(stations)), schedule_(stations_.size()), timing_(timing),
      longest_silence_(longest_silence)
{
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        const modbus::serial_options& each = stations_[i].timing;
        schedule_.set_longest_delay(i, std::max(least_longest_delay, (each.retries + 2) * each.response_timeout));
    }
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
    row& of = routes_[turn.item];
    const health before = schedule_.state_of(of.station);
    schedule_.finished(turn, schedule::outcome::answered, now - q.asked_at, now, late);
    if (before == health::down)
        note(line_event::severity::info, label(stations_[of.station]) + " answers again");

    of.answered = true;
    if (const auto refused = refusal_in(answer)) {
        ++reading(of).content.errors;
        set_quality(of, quality::device_error, refused->reason, refused->code);
        if (writes(of.content.way))
            was_refused(of, q, now, refused->may_pass);
        return;
    }
    if (!is_outdated(of, q)) {
        const std::vector<std::uint16_t> words_before = of.content.words;
        store(of.content, q.asked, answer);
        was_stored(of, q, now);
        of.changed = of.changed || of.content.words != words_before;
    }
    of.content.source = wall;
    of.good_at = now;
    ++of.content.answers;
    set_quality(of, quality::good, {});
}

void client_line::failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late)
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
    const std::string reason = reason_of(q.asked, why);
    const auto code = static_cast<std::uint16_t>(code_of(why));
    ++reading(of).content.errors;
    set_quality(of, quality::comm_error, reason, code);
    if (before != health::down && schedule_.state_of(of.station) == health::down)
        station_down(of.station, reason, code);
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
        lose(each, why, static_cast<std::uint16_t>(no_answer::no_port));
    forwards_.answer_all(errc::port_absent);
    port_open_ = false;
}

std::vector<sample> client_line::take_samples(time_point now)
{
    std::vector<sample> samples;
    for (row& each : routes_) {
        age(each, now);
        const bool confirmed = each.answered && now - each.said_at >= longest_silence_;
        if (each.half || (!each.changed && !confirmed))
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
        set_quality(of, quality::stale, "not read for more than " + std::to_string(periods_until_stale) + " periods",
                    static_cast<std::uint16_t>(no_answer::not_renewed));
}

void client_line::say_everything()
{
    for (row& each : routes_)
        each.changed = true;
}

bool client_line::is_up(std::size_t number) const
{
    const route& of = routes_[number].content;
    return of.state == quality::good ||
           (writes(of.way) && of.state == quality::never_read);  // had nothing to write yet
}

std::size_t client_line::routes_up() const
{
    std::size_t up = 0;
    for (std::size_t i = 0; i < routes_.size(); ++i)
        if (!is_half(i) && is_up(i))
            ++up;
    return up;
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

void client_line::set_quality(row& of, quality state, const std::string& reason, std::uint16_t code)
{
    route& r = of.content;
    if (r.state == quality::substituted && state == quality::comm_error)
        state = r.state;  // still lost
    if (state == quality::device_error && (r.state != state || r.reason != reason))
        note(line_event::severity::warning,
             "line " + name_ + ", route " + r.name + ": " + label(stations_[of.station]) + " refuses: " + reason);
    if (r.state == quality::device_error && state == quality::good)
        note(line_event::severity::info, "line " + name_ + ", route " + r.name + ": accepted again");
    of.changed = of.changed || r.state != state;
    r.state = state;
    r.reason = reason;
    r.reason_code = code;
}

void client_line::station_down(std::size_t index, const std::string& reason, std::uint16_t code)
{
    bool replaced = false;
    for (row& each : routes_) {
        if (each.station != index)
            continue;
        lose(each, reason, code);
        replaced = replaced || each.content.state == quality::substituted;
    }
    note(line_event::severity::warning, label(stations_[index]) + " does not answer (" + reason + "): its values are " +
                                            (replaced ? "kept or replaced as on_loss says" : "kept") +
                                            ", it is probed from now on");
}

std::string client_line::label(const station& of) const
{
    return "line " + name_ + ", station " + of.name + " (unit " + std::to_string(number(of.unit)) + ")";
}

}  // namespace plcgw
