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
};

constexpr std::string_view to_string(quality q)
{
    switch (q) {
    case quality::never_read: return "never read";
    case quality::good: return "good";
    case quality::stale: return "stale";
    case quality::comm_error: return "comm error";
    case quality::device_error: return "device error";
    }
    return "unknown";
}

}  // namespace plcgw
