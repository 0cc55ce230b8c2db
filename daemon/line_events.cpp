#include "daemon/line_events.hpp"

#include "daemon/log.hpp"

namespace plcgw {
namespace {

// Like the log: whoever has something to say is not handed a way to say it.
std::function<void(const line_event&)>& event_sink()
{
    static std::function<void(const line_event&)> sink;
    return sink;
}

log_level level_of(line_event::severity level)
{
    switch (level) {
    case line_event::severity::info: return log_level::info;
    case line_event::severity::warning: return log_level::warning;
    case line_event::severity::error: return log_level::error;
    }
    return log_level::error;
}

}  // namespace

void say(const line_event& event)
{
    log::write(level_of(event.level), event.text);
    if (event_sink())
        event_sink()(event);
}

void log_events(const std::vector<line_event>& events)
{
    for (const line_event& event : events)
        say(event);
}

void set_event_sink(std::function<void(const line_event&)> sink) { event_sink() = std::move(sink); }

}  // namespace plcgw
