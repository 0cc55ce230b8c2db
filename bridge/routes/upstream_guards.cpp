#include "bridge/routes/upstream_guards.hpp"

namespace plcgw {
namespace {

// No sign of life: these are nobody's writes.
void put_safe(const upstream_guard& g)
{
    for (std::size_t bit = 0; bit < g.bits; ++bit)
        g.plc->memory().put_bit({g.at.area, g.at.bit + bit}, (g.safe[bit / 16] >> bit % 16 & 1U) != 0);
}

std::string seconds(duration d)
{
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(d).count();
    return ms % 1000 == 0 ? std::to_string(ms / 1000) + " s" : std::to_string(ms) + " ms";
}

}  // namespace

void upstream_guards::add(upstream_guard guard)
{
    row& added = rows_.emplace_back();
    added.watch = guard.plc->memory().watch_writes(guard.at, guard.bits);
    added.content = std::move(guard);
}

void upstream_guards::start(time_point now)
{
    for (row& each : rows_)
        each.until = now + each.content.longest_silence;
}

void upstream_guards::written(time_point now)
{
    for (row& each : rows_) {
        if (!each.content.plc->memory().take_written(each.watch))
            continue;
        each.until = now + each.content.longest_silence;
        if (std::exchange(each.lost, false))
            events_.push_back({line_event::severity::info, "upstream.back", each.content.name,
                               "route " + each.content.name + ": its devices are written again, no more safe values"});
    }
}

void upstream_guards::look(time_point now)
{
    for (row& each : rows_) {
        if (each.lost || now < each.until)
            continue;
        each.lost = true;
        put_safe(each.content);
        events_.push_back({line_event::severity::warning, "upstream.silent", each.content.name,
                           "route " + each.content.name + ": nobody wrote its devices for " +
                               seconds(each.content.longest_silence) + ", the safe values go to the station"});
    }
}

time_point upstream_guards::wake_at() const
{
    time_point earliest = time_point::max();
    for (const row& each : rows_)
        if (!each.lost)
            earliest = std::min(earliest, each.until);
    return earliest;
}

}  // namespace plcgw
