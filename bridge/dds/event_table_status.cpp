// Ports, devices and events in the table of `plc-gateway watch`.
#include "bridge/dds/event_table.hpp"
#include "bridge/dds/event_text.hpp"
#include "bridge/dds/table_row.hpp"

#include <fmt/format.h>

namespace plcgw {
namespace {

constexpr std::size_t events_shown = 8;

line_style style_of(link_state state)
{
    switch (state) {
    case link_state::up: return line_style::plain;
    case link_state::degraded: return line_style::warning;
    case link_state::down: return line_style::error;
    case link_state::unknown:
    case link_state::disabled:
    case link_state::starting: break;
    }
    return line_style::old;
}

// Counters and times are no news.
template <class Rows, class Received, class Row>
bool take_status(Rows& rows, const std::string& name, const Received& e, const Row& next)
{
    const auto [at, is_new] = rows.try_emplace({e.gateway, name}, next);
    const bool changed = is_new || at->second.state != next.state || at->second.last.status.state != e.status.state ||
                         at->second.last.status.detail != e.status.detail;
    at->second = next;
    return changed;
}

template <class Rows, class Writer>
bool take_gone(Rows& rows, const std::pair<std::string, std::string>& key, gone_reason reason, Writer lost)
{
    const auto row = rows.find(key);
    if (row == rows.end())
        return false;
    if (reason == gone_reason::disposed)
        rows.erase(row);
    else
        row->second.state = lost;
    return true;
}

std::string milliseconds_text(std::uint32_t us) { return us == 0 ? "-" : fmt::format("{:.1f}", us / 1000.0); }

}  // namespace

bool event_table::apply_one(const received_port& e, wall_time)
{
    return take_status(ports_, e.status.port, e, status_row<received_port>{e, writer::alive});
}

bool event_table::apply_one(const received_device& e, wall_time)
{
    return take_status(devices_, e.status.device, e, status_row<received_device>{e, writer::alive});
}

bool event_table::apply_one(const received_event& e, wall_time)
{
    events_.push_back(e);
    if (events_.size() > events_shown)
        events_.pop_front();
    return true;
}

bool event_table::apply_one(const gone_port& e, wall_time)
{
    return take_gone(ports_, {e.gateway, e.port}, e.reason, writer::lost);
}

bool event_table::apply_one(const gone_device& e, wall_time)
{
    return take_gone(devices_, {e.gateway, e.device}, e.reason, writer::lost);
}

void event_table::port_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const
{
    bool headed = false;
    for (const auto& [key, row] : ports_) {
        if (key.first != gateway)
            continue;
        if (!std::exchange(headed, true))
            out.push_back({line_style::heading, row_text(' ', "PORT", "FRAMES IN/OUT", "STATE", "SINCE", "ERRORS")});
        const port_status& s = row.last.status;
        const bool lost = row.state == writer::lost;
        const std::string errors =
            s.detail.empty() ? std::to_string(s.errors) : fmt::format("{}, last: {}", s.errors, printable(s.detail));
        out.push_back({lost ? line_style::old : style_of(s.state),
                       row_text(lost                          ? 'x'
                                : s.state == link_state::down ? '!'
                                                              : ' ',
                                printable(s.port), fmt::format("{}/{}", s.rx_frames, s.tx_frames),
                                lost ? "gone" : to_string(s.state), age_text(s.since, now), errors)});
    }
}

void event_table::device_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const
{
    bool headed = false;
    for (const auto& [key, row] : devices_) {
        if (key.first != gateway)
            continue;
        if (!std::exchange(headed, true))
            out.push_back({line_style::heading,
                           row_text(' ', "DEVICE", "PORT", "STATE", "SINCE", "ANSWER/CYCLE ms, TIMEOUTS/REQUESTS")});
        const device_status& s = row.last.status;
        const bool lost = row.state == writer::lost;
        const bool bad = s.state == link_state::down || s.state == link_state::degraded;
        std::string values = fmt::format("{}/{}, {}/{}", milliseconds_text(s.rtt_us), milliseconds_text(s.cycle_us),
                                         s.timeouts, s.requests);
        if (!s.detail.empty())
            values += ": " + printable(s.detail);
        out.push_back({lost ? line_style::old : style_of(s.state),
                       row_text(lost  ? 'x'
                                : bad ? '!'
                                      : ' ',
                                printable(s.device), printable(s.port), lost ? "gone" : to_string(s.state),
                                age_text(s.since, now), values)});
    }
}

void event_table::event_lines(const std::string& gateway, std::vector<table_line>& out) const
{
    bool headed = false;
    for (const received_event& each : events_) {
        if (each.gateway != gateway)
            continue;
        if (!std::exchange(headed, true))
            out.push_back({line_style::heading, "  LAST EVENTS"});
        out.push_back({each.level == line_event::severity::info      ? line_style::plain
                       : each.level == line_event::severity::warning ? line_style::warning
                                                                     : line_style::error,
                       "  " + line_of(each)});
    }
}

}  // namespace plcgw
