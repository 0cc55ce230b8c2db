// What a line and its routes say of themselves: samples, ages, qualities, load.
#include "bridge/routes/client_line.hpp"
#include "bridge/routes/route_status.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr int periods_until_stale = 3;

}  // namespace

std::vector<sample> client_line::take_samples(time_point now)
{
    std::vector<sample> samples;
    for (row& each : routes_) {
        age(each, now);
        const bool confirmed = each.answered && now - each.said_at >= options_.longest_silence;
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

// Told once, and again when it has fitted for a while.
void client_line::note_load(time_point now)
{
    constexpr duration period = std::chrono::seconds(10);
    constexpr double much = 1.05;
    if (now - load_looked_at_ < period)
        return;
    load_looked_at_ = now;
    const bool is_over = overloaded_ ? schedule_.stretch() > 1 : schedule_.stretch() > much;
    if (is_over == std::exchange(overloaded_, is_over))
        return;
    const auto percent = [](double of) { return std::to_string(static_cast<int>(of * 100 + 0.5)); };
    if (is_over)
        note(line_event::severity::warning, "line.overload", name_,
             "line " + name_ + " is overloaded: its reads need " + percent(schedule_.wanted()) +
                 " % of it, so that all periods are " + percent(schedule_.stretch()) + " % of what was asked for");
    else
        note(line_event::severity::info, "line.relieved", name_, "line " + name_ + " keeps its periods again");
}

device_status client_line::device_of(std::size_t station) const
{
    device_status status = statistics_.status_of(station);
    status.device = stations_[station].name;
    status.port = name_;
    if (const auto mean = times_[station].mean())
        status.rtt_us = static_cast<std::uint32_t>(std::clamp<std::int64_t>(mean->count(), 0, UINT32_MAX));
    return status;
}

}  // namespace plcgw
