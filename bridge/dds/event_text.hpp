// Events as text for people. What foreign writers sent never reaches the terminal as a control character.
#pragma once

#include "bridge/dds/event.hpp"

#include <string>
#include <vector>

namespace plcgw {

// UTC with milliseconds, "2026-03-04T05:06:07.089Z"; "never" for wall_time::never.
std::string iso_time(wall_time t);

std::string age_text(wall_time then, wall_time now);  // "0.2 s", "35 s", "12 min"; "-" if never

std::string printable(const std::string& text);

// One number for each register or bit; never more than words holds, whatever count says.
std::vector<std::uint16_t> values_of(const sample& s);
std::string values_text(const sample& s);         // "1 2 3", or bits as "0110"
std::string value_text(const received_point& p);  // "21.5 Cel", "on", "-" when there is none

std::string register_text(const std::string& area, std::uint32_t first, std::uint32_t count);  // "holding 100..103"
std::string status_text(const received_status& s);                                             // "solo, routes 3/4 up"
std::string port_text(const port_status& s);
std::string device_text(const device_status& s);
std::string_view to_string(gone_reason reason);
std::string_view to_string(message_direction way);
std::string_view to_string(point_kind kind);

std::string line_of(const dds_event& event);  // one line without its end

}  // namespace plcgw
