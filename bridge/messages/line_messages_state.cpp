// What others see of a line's messages: qualities, samples, the words of the status area.
#include "bridge/messages/line_messages.hpp"

#include <algorithm>

namespace plcgw::messages {
namespace {

sample sample_of(const plc_block& where, const standing& of)
{
    sample made = plcgw::sample_of(where, of.source());
    made.state = of.state();
    return made;
}

void worsen_by(sample& of, const standing& by)
{
    if (by.state() != quality::good && of.state == quality::good)
        of.state = by.state();
    of.source = std::min(of.source, by.source());
}

}  // namespace

std::vector<sample> line_messages::take_samples(time_point now)
{
    std::vector<sample> samples;
    for (raw& each : raws_)
        if (each.stands.due(now, options_.longest_silence))
            samples.push_back(sample_of(each.row.into, each.stands));
    for (route& each : routes_) {
        const quality before = each.stands.state();
        each.stands.age(now, each.row.longest_silence);
        if (each.stands.state() != before)
            note(line_event::severity::warning, "message.missing", each.row.name,
                 label("message", each.row.name) + " has not come for " +
                     std::to_string(each.row.longest_silence.count() / 1000) + " ms");
        if (each.stands.due(now, options_.longest_silence))
            for (const plc_block& where : each.row.into)
                samples.push_back(sample_of(where, each.stands));
    }
    return samples;
}

void line_messages::say_everything()
{
    for (raw& each : raws_)
        each.stands.change();
    for (route& each : routes_)
        each.stands.change();
}

std::size_t line_messages::routes_up() const
{
    // A bar-code reader that has read nothing yet is not broken.
    const auto up = [this](const standing& of, duration longest) {
        const bool waits = of.state() == quality::never_read && open_ && longest == duration{};
        return of.state() == quality::good || waits;
    };
    std::size_t count = 0;
    for (const raw& each : raws_)
        count += up(each.stands, {}) ? 1 : 0;
    for (const route& each : routes_)
        count += up(each.stands, each.row.longest_silence) ? 1 : 0;
    return count;
}

std::vector<plc_block> line_messages::filled() const
{
    std::vector<plc_block> all;
    for (const raw& each : raws_)
        all.push_back(each.row.into);
    for (const route& each : routes_)
        all.insert(all.end(), each.row.into.begin(), each.row.into.end());
    return all;
}

void line_messages::worsen(sample& of, const plc::simulated_plc& plc, plc::place at, std::size_t bits) const
{
    const plc::change span{at.area, at.bit, bits};
    for (const raw& each : raws_)
        if (touches(each.row.into, plc, span))
            worsen_by(of, each.stands);
    for (const route& each : routes_)
        for (const plc_block& where : each.row.into)
            if (touches(where, plc, span))
                worsen_by(of, each.stands);
}

bool line_messages::memory_changed(const plc::simulated_plc& plc, const plc::change& changed, time_point now)
{
    bool due = false;
    for (std::size_t i = 0; i < sends_.size(); ++i) {
        const plc_bit& trigger = sends_[i].row.trigger;
        if (!trigger.touched_by(plc, changed))
            continue;
        schedule_.trigger(i, trigger.level(), now);
        due = due || trigger.level();
    }
    for (const raw& each : raws_)
        work_due_ = work_due_ || (each.row.ready.touched_by(plc, changed) && !each.row.ready.level());
    if (reset_.touched_by(plc, changed)) {
        const bool before = std::exchange(reset_level_, reset_.level());
        reset_due_ = reset_due_ || (reset_level_ && !before);
        work_due_ = work_due_ || reset_due_;
    }
    return due || work_due_;
}

void line_messages::port_opened()
{
    in_.reset();
    open_ = true;
}

void line_messages::port_lost()
{
    in_.reset();
    open_ = false;
    quiet_until_ = {};
    lose_ordered();
    for (raw& each : raws_)
        each.stands.lose();
    for (route& each : routes_)
        each.stands.lose();
}

void line_messages::reset_channel()
{
    in_.reset();
    port_.reset();
    for (raw& each : raws_) {
        each.buffers.reset();
        each.said_full = false;
    }
    news_ = {.reset = true};
    show_status();
    note(line_event::severity::info, "line.reset", name(), "line " + name() + ": the channel was reset");
}

void line_messages::show_status_in(plc_block where) { status_ = std::move(where); }

std::uint16_t line_messages::status(status_word which) const
{
    std::uint64_t value = 0;
    switch (which) {
    case status_word::error_code:
        value = port_.error_code();
        for (const raw& each : raws_)
            value |= each.buffers.error_code();
        break;
    case status_word::error_count: value = port_.error_count(); break;
    case status_word::waiting:
        for (const raw& each : raws_)
            value = std::max<std::uint64_t>(value, each.buffers.waiting());
        break;
    case status_word::received: value = received_; break;
    case status_word::refused: value = refused_; break;
    case status_word::lost:
        value = too_long_;
        for (const raw& each : raws_)
            value += each.buffers.counters().lost;
        break;
    case status_word::sent: value = sent_; break;
    case status_word::unanswered: value = unanswered_; break;
    }
    return static_cast<std::uint16_t>(value);
}

void line_messages::show_status()
{
    if (status_.plc == nullptr)
        return;
    for (std::size_t i = 0; i < status_words; ++i)
        status_.plc->memory().set_word({status_.at.area, status_.at.bit + 16 * i}, status(static_cast<status_word>(i)));
}

std::string line_messages::label(const char* what, const std::string& row) const
{
    return "line " + name() + ", " + what + " " + row;
}

}  // namespace plcgw::messages
