// What follows an exchange on a line or a request of a client: changes are drained, and said.
#include "daemon/gateway.hpp"
#include "daemon/line_events.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned most_copy_rounds = 64;  // of copies of copies; what is left then is copied the next time

}  // namespace

void gateway::settle(running_line& line)
{
    log_events(line.routes.take_events());
    learned_.keep_if_new(line, lines_);
    line.gate.deliver();
    through_.deliver();
    if (is_active())
        line.statuses.show(wall_now());
    if (standby_)
        standby_->settled(line);
    settle_memory();
    say(line.routes.take_samples(now()));
    statuses_.look_at_states(now(), wall_now());
}

void gateway::settle(message_line& line)
{
    settle_memory();
    const std::vector<sample> samples = line.content.take_samples(now());
    log_events(line.content.take_events());
    writes_.deliver(line);
    for (const serial_message& each : line.content.take_messages())
        dds_.publish(each);
    say(samples);
    statuses_.look_at_states(now(), wall_now());
}

void gateway::settle_server_line()
{
    settle_memory();
    statuses_.look_at_states(now(), wall_now());
}

void gateway::say(const std::vector<sample>& samples)
{
    if (standby_)
        standby_->say(samples);  // before a subscriber knows it
    for (const sample& each : samples)
        dds_.publish(each);
    if (samples.empty())
        return;
    blocks_.qualities_changed();
    blocks_.publish();
    points_.say(samples);
    points_.publish();
}

void gateway::settle_memory()
{
    fp7_ports_.look();
    bool changed_any = false;
    note_writes();
    for (unsigned round = 0; round < most_copy_rounds && drain_changes(); ++round) {
        changed_any = true;
        note_writes();  // copies write, too
    }
    if (standby_)
        standby_->publish();
    if (!changed_any)
        return;
    if (links_)
        links_->send();
    for (const auto& program : programs_)
        program->look();
    blocks_.publish();
    points_.publish();
}

void gateway::note_writes()
{
    bool written_any = false;
    for (const auto& plc : plcs_)
        written_any = plc->memory().take_written() || written_any;
    if (!written_any)
        return;
    upstream_.written();
    for (const auto& line : lines_)
        if (line->routes.memory_written())
            line->driver->wake();
}

bool gateway::drain_changes()
{
    bool changed_any = false;
    for (const auto& plc : plcs_) {
        for (const plc::change& changed : plc->memory().take_changes()) {
            changed_any = true;
            copies_.memory_changed(*plc, changed);
            for (const auto& line : lines_)
                if (line->routes.memory_changed(*plc, changed))
                    line->driver->wake();
            for (const auto& line : message_lines_)
                if (is_active() && line->content.memory_changed(*plc, changed, now()))
                    line->wake();
            blocks_.memory_changed(*plc, changed);
            points_.memory_changed(*plc, changed);
            if (links_)
                links_->memory_changed(*plc, changed);
            if (standby_)
                standby_->memory_changed(*plc, changed);
        }
    }
    return changed_any;
}

}  // namespace plcgw
