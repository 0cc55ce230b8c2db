// Where gateways and subscribers meet: DDS domain, network interface, peers and partition.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plcgw {

struct dds_settings {
    bool enabled = true;
    std::uint32_t domain = 0;        // 0..230
    std::string interface = "lo";    // as `ip link` names it; empty: Cyclone chooses
    std::vector<std::string> peers;  // where multicast does not reach: IP addresses, since looking up a name blocks
    std::string partition;           // only the same partition is seen; empty: the default one
};

// Cyclone's configuration for these settings. The partition is not part of it: that is QoS.
std::string cyclone_xml(const dds_settings& settings);

}  // namespace plcgw
