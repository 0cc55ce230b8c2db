// The topics of registers.idl and messages.idl, and what a site may set of each.
#pragma once

#include "protocols/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace plcgw {

enum class dds_topic : std::uint8_t {
    serial_message,
    event,
    register_block,
    point,
    port_status,
    device_status,
    gateway_status,
};
inline constexpr std::size_t dds_topics = 7;

constexpr bool is_state(dds_topic which) { return which > dds_topic::event; }

// Both members of a hot-standby pair write the same instances, one at a time. GatewayStatus has the member in its key.
constexpr bool is_shared_by_a_pair(dds_topic which) { return is_state(which) && which != dds_topic::gateway_status; }

constexpr std::string_view to_string(dds_topic which)
{
    constexpr std::array<std::string_view, dds_topics> names{"SerialMessage", "Event",        "RegisterBlock", "Point",
                                                             "PortStatus",    "DeviceStatus", "GatewayStatus"};
    return names[static_cast<std::size_t>(which)];
}

constexpr const char* topic_name(dds_topic which)
{
    constexpr std::array<const char*, dds_topics> names{
        "plcgw/v1/SerialMessage", "plcgw/v1/Event",        "plcgw/v1/RegisterBlock", "plcgw/v1/Point",
        "plcgw/v1/PortStatus",    "plcgw/v1/DeviceStatus", "plcgw/v1/GatewayStatus"};
    return names[static_cast<std::size_t>(which)];
}

enum class dds_reliability : std::uint8_t { reliable, best_effort };

// Only what is safe: no setting makes a write wait, or keeps Fast DDS readers out.
struct topic_settings {
    bool enabled = true;
    dds_reliability reliability = dds_reliability::reliable;
    std::chrono::milliseconds deadline{0};  // offered; 0: none
    unsigned history = 0;                   // of events and messages: kept for a slow reader; 0: 256
    bool operator==(const topic_settings&) const = default;
};

}  // namespace plcgw
