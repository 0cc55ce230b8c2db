// How a port and a device do: PortStatus and DeviceStatus of registers.idl.
#pragma once

#include "protocols/time.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace plcgw {

enum class link_state : std::uint8_t { unknown, disabled, down, starting, up, degraded };  // STATE_*

constexpr std::string_view to_string(link_state state)
{
    switch (state) {
    case link_state::unknown: return "unknown";
    case link_state::disabled: return "disabled";
    case link_state::down: return "down";
    case link_state::starting: return "starting";
    case link_state::up: return "up";
    case link_state::degraded: return "degraded";
    }
    return "unknown state";
}

// A serial port, a connection that stands for one, a listener, or the DDS side.
struct port_status {
    std::string port;
    link_state state{};
    wall_time since = wall_time::never;  // when this state began
    std::uint64_t rx_frames = 0;
    std::uint64_t tx_frames = 0;
    std::uint64_t rx_bytes = 0;
    std::uint64_t tx_bytes = 0;
    std::uint64_t errors = 0;   // damaged frames, bytes that are none, refused clients
    std::uint64_t reopens = 0;  // times that it came back
    std::string detail;         // last error as text, may be empty
    bool operator==(const port_status&) const = default;
};

// A configured station.
struct device_status {
    std::string device;
    std::string port;  // its line
    link_state state{};
    wall_time since = wall_time::never;
    wall_time last_ok = wall_time::never;  // last good answer
    std::uint64_t requests = 0;            // sent, each repetition too
    std::uint64_t timeouts = 0;
    std::uint64_t exceptions = 0;
    std::uint32_t rtt_us = 0;    // smoothed response time; 0: not measured yet
    std::uint32_t cycle_us = 0;  // achieved period of its most frequent read route, smoothed
    std::string detail;
    bool operator==(const device_status&) const = default;
};

}  // namespace plcgw
