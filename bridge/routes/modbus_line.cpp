#include "bridge/routes/modbus_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int periods_until_stale = 3;

std::string exception_text(modbus::exception_code code)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto value = static_cast<unsigned>(code);
    return std::string("exception ") + digits[value / 16 % 16] + digits[value % 16] + " (" +
           std::string(modbus::to_string(code)) + ")";
}

}  // namespace

modbus_line::modbus_line(std::string name, std::vector<station> stations, duration longest_silence)
    : name_(std::move(name)), stations_(std::move(stations)), schedule_(stations_.size()),
      longest_silence_(longest_silence)
{
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

std::optional<modbus_line::question> modbus_line::next(time_point now)
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

void modbus_line::answered(const question& q, const modbus::response& answer, time_point now, wall_time wall,
                           unanswered_requests late)
{
    row& of = routes_[q.turn.item];
    const health before = schedule_.state_of(of.station);
    schedule_.finished(q.turn, schedule::outcome::answered, now - q.asked_at, now, late);
    if (before == health::down)
        note(line_event::severity::info, label(stations_[of.station]) + " answers again");

    of.answered = true;
    if (const auto* refused = std::get_if<modbus::exception_code>(&answer)) {
        set_quality(of, quality::device_error, exception_text(*refused));
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
    row& of = routes_[q.turn.item];
    const health before = schedule_.state_of(of.station);
    const bool asked = why != errc::line_not_quiet;
    schedule_.finished(q.turn, asked ? schedule::outcome::silent : schedule::outcome::not_asked, now - q.asked_at, now,
                       late);
    set_quality(of, quality::comm_error, why.message());
    if (before != health::down && schedule_.state_of(of.station) == health::down)
        station_down(of.station, why.message());
}

void modbus_line::interrupted(const question& q)
{
    if (routes_[q.turn.item].content.way == direction::write)
        schedule_.ask(q.turn.item);
}

void modbus_line::port_lost(const std::string& why)
{
    for (row& each : routes_)
        set_quality(each, quality::comm_error, why);
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
    return static_cast<std::size_t>(std::count_if(routes_.begin(), routes_.end(),
                                                  [](const row& each) { return each.content.state == quality::good; }));
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
            set_quality(each, quality::comm_error, reason);
}

std::string modbus_line::label(const station& of) const
{
    return "line " + name_ + ", station " + of.name + " (unit " + std::to_string(modbus::number(of.unit)) + ")";
}

}  // namespace plcgw
