#include "daemon/line_events.hpp"

#include "daemon/log.hpp"

namespace plcgw {

void log_events(const std::vector<line_event>& events)
{
    for (const line_event& event : events)
        log::write(event.level == line_event::severity::warning ? log_level::warning : log_level::info, event.text);
}

}  // namespace plcgw
