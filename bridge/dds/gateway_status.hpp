// What a gateway says about itself, beside its registers.
#pragma once

#include "protocols/time.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace plcgw {

// Who publishes. Two members of a hot-standby pair have the same gateway name.
struct dds_identity {
    std::string gateway;
    std::string member;
    std::string version;
    std::string config_hash;
    bool operator==(const dds_identity&) const = default;
};

enum class gateway_role : std::uint8_t { solo, active, standby };

constexpr std::string_view to_string(gateway_role role)
{
    switch (role) {
    case gateway_role::solo: return "solo";
    case gateway_role::active: return "active";
    case gateway_role::standby: return "standby";
    }
    return "unknown role";
}

struct gateway_status {
    gateway_role role = gateway_role::solo;
    std::int32_t strength = 0;  // ownership strength in use
    wall_time started{};
    std::uint32_t routes_up = 0;
    std::uint32_t routes_total = 0;
    bool operator==(const gateway_status&) const = default;
};

}  // namespace plcgw
