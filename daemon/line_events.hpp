// What there is to say about lines, stations, routes, ports and DDS: in the log, and as DDS events.
#pragma once

#include "bridge/line_event.hpp"

#include <fmt/core.h>

#include <functional>
#include <utility>
#include <vector>

namespace plcgw {

void say(const line_event& event);
void log_events(const std::vector<line_event>& events);

template <class... Args>
void say(line_event::severity level, std::string_view code, std::string subject, fmt::format_string<Args...> format,
         Args&&... args)
{
    const line_event event{level, code, std::move(subject), fmt::format(format, std::forward<Args>(args)...)};
    say(event);
}

// Where they go besides the log: one place, on the thread of the loop. Empty: nowhere.
void set_event_sink(std::function<void(const line_event&)> sink);

}  // namespace plcgw
