#include "daemon/statuses.hpp"

#include <algorithm>

namespace plcgw {

void published_statuses::add(client_line& line)
{
    lines_.push_back(&line);
    for (std::size_t i = 0; i < line.stations_total(); ++i)
        devices_.push_back({&line, i, {}, {}, true});
}

// The line knows no wall clock: a state began when it was first seen, right after the exchange that changed it.
device_status published_statuses::next_of(const device_row& device, wall_time wall) const
{
    device_status next = device.line->device_of(device.station);
    const bool same = next.state == device.said.state && device.said.since != wall_time::never;
    next.since = same ? device.said.since : wall;
    return next;
}

void published_statuses::say(port_row& port, time_point now)
{
    port.said = *port.now;
    port.said_at = now;
    port.due = false;
    dds_.publish(port.said);
}

void published_statuses::say(device_row& device, const device_status& next, time_point now)
{
    device.said = next;
    device.said_at = now;
    device.due = false;
    dds_.publish(next);
}

void published_statuses::look_at_states(time_point now, wall_time wall)
{
    for (port_row& each : ports_)
        if (each.now->state != each.said.state)
            say(each, now);
    bool changed = false;
    for (client_line* const each : lines_)
        changed = each->take_device_changes() || changed;
    if (!changed)
        return;
    for (device_row& each : devices_)
        if (each.line->device_state(each.station) != each.said.state)
            say(each, next_of(each, wall), now);
}

bool published_statuses::look(time_point now, wall_time wall)
{
    constexpr std::size_t most = 100;
    const std::size_t all = ports_.size() + devices_.size();
    const std::size_t end = std::min(looked_at_ + most, all);
    for (; looked_at_ < end; ++looked_at_) {
        if (looked_at_ < ports_.size())
            look(ports_[looked_at_], now);
        else
            look(devices_[looked_at_ - ports_.size()], now, wall);
    }
    if (looked_at_ < all)
        return true;
    looked_at_ = 0;
    return false;
}

void published_statuses::look(port_row& port, time_point now)
{
    if (port.due || now - port.said_at >= longest_silence_ || *port.now != port.said)
        say(port, now);
}

void published_statuses::look(device_row& device, time_point now, wall_time wall)
{
    const device_status next = next_of(device, wall);
    if (device.due || now - device.said_at >= longest_silence_ || next != device.said)
        say(device, next, now);
}

void published_statuses::say_everything()
{
    looked_at_ = 0;
    for (port_row& each : ports_)
        each.due = true;
    for (device_row& each : devices_)
        each.due = true;
}

}  // namespace plcgw
