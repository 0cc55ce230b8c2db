// Something notable about a line, a station, a route, a port or DDS: for the log, and as a DDS Event.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace plcgw {

struct line_event {
    enum class severity : std::uint8_t { info, warning, error } level{};  // as SEVERITY_* of registers.idl
    std::string_view code;  // stable, of docs/dds.md: "device.down"; a literal
    std::string subject;    // the line, station, route, message or point
    std::string text;       // a sentence, with the place
};

constexpr std::string_view to_string(line_event::severity level)
{
    switch (level) {
    case line_event::severity::info: return "info";
    case line_event::severity::warning: return "warning";
    case line_event::severity::error: return "error";
    }
    return "unknown";
}

}  // namespace plcgw
