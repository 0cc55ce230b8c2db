// How far a value can be trusted. bridge/dds/registers.idl maps these to the classic OPC codes.
#pragma once

#include <cstdint>
#include <string_view>

namespace plcgw {

enum class quality : std::uint8_t {
    never_read,    // no answer since start: the value is the memory's initial one
    good,          // read within the route's period
    stale,         // not renewed for three periods, for example because the line is overloaded
    comm_error,    // the station does not answer or the port is absent: the value is the last known one
    device_error,  // the station answered with an exception
    substituted,   // the station is lost, and the memory shows what the route says for that: on_loss
    // Of points alone, which know what their registers mean.
    out_of_limits,  // the value is outside min and max
    no_value,       // the registers hold none: a NaN, an infinity, or digits that are none in BCD
};

// The classic OPC codes, as DDS and the status words show them: less than 64 is bad, less than 192 uncertain. 72 is
// what FOUNDATION Fieldbus and PROFIBUS call a substitute value, of which OPC says nothing of its own.
constexpr std::uint16_t code_of(quality q)
{
    switch (q) {
    case quality::never_read: return 0;
    case quality::device_error: return 12;
    case quality::no_value: return 16;
    case quality::comm_error: return 24;
    case quality::stale: return 68;
    case quality::substituted: return 72;
    case quality::out_of_limits: return 84;
    case quality::good: return 192;
    }
    return 0;
}

constexpr std::string_view to_string(quality q)
{
    switch (q) {
    case quality::never_read: return "never read";
    case quality::good: return "good";
    case quality::stale: return "stale";
    case quality::comm_error: return "comm error";
    case quality::device_error: return "device error";
    case quality::substituted: return "substituted";
    case quality::out_of_limits: return "out of limits";
    case quality::no_value: return "no value";
    }
    return "unknown";
}

}  // namespace plcgw
