#include "bridge/messages/send_schedule.hpp"

#include <algorithm>

namespace plcgw::messages {

std::size_t send_schedule::add_periodic(duration period)
{
    sources_.emplace_back().period = period;
    return sources_.size() - 1;
}

std::size_t send_schedule::add_triggered()
{
    sources_.emplace_back();
    return sources_.size() - 1;
}

void send_schedule::start(time_point now)
{
    for (row& each : sources_)
        if (each.period > duration{})
            each.due = now;
}

void send_schedule::trigger(std::size_t index, bool level, time_point now)
{
    const bool before = sources_[index].level.value_or(true);
    sources_[index].level = level;
    if (level && !before)
        request(index, now);
}

void send_schedule::request(std::size_t index, time_point now)
{
    row& of = sources_[index];
    if (of.requested)
        ++of.merged;
    else
        of.requested = now;
}

std::optional<std::size_t> send_schedule::next(time_point now)
{
    std::optional<std::size_t> asked;
    std::optional<std::size_t> periodic;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const row& each = sources_[i];
        if (each.under_way)
            continue;
        if (each.requested && (!asked || *each.requested < *sources_[*asked].requested))
            asked = i;
        if (each.due <= now && (!periodic || each.due < sources_[*periodic].due))
            periodic = i;
    }
    if (periodic && asked_last_)
        asked.reset();
    const std::optional<std::size_t> chosen = asked ? asked : periodic;
    if (!chosen)
        return std::nullopt;

    row& of = sources_[*chosen];
    of.under_way = true;
    asked_last_ = asked.has_value();
    if (asked) {
        of.requested.reset();
        return chosen;
    }
    // On the grid of the start, so that periods do not drift; without a burst after a long time.
    const auto passed = (now - of.due) / of.period;
    of.missed += static_cast<std::uint64_t>(passed);
    of.due += (passed + 1) * of.period;
    return chosen;
}

void send_schedule::finished(std::size_t index) { sources_[index].under_way = false; }

time_point send_schedule::wake_at() const
{
    time_point soonest = time_point::max();
    for (const row& each : sources_)
        if (!each.under_way)
            soonest = std::min({soonest, each.due, each.requested.value_or(time_point::max())});
    return soonest;
}

}  // namespace plcgw::messages
