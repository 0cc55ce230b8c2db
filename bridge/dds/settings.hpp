// Where gateways and subscribers meet: DDS domain, network interface, peers and partition.
#pragma once

#include "bridge/dds/topics.hpp"

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
    std::vector<std::string> partitions;    // several, in addition
    std::chrono::milliseconds lease{5000};  // after it others take a participant that is not heard for dead
    std::string cyclone_config;             // path of a Cyclone configuration file in place of ours
    std::array<topic_settings, dds_topics> topics{};

    const topic_settings& topic(dds_topic which) const { return topics[static_cast<std::size_t>(which)]; }
    topic_settings& topic(dds_topic which) { return topics[static_cast<std::size_t>(which)]; }
};

// Cyclone's configuration for these settings. The partition is not part of it: that is QoS.
std::string cyclone_xml(const dds_settings& settings);

}  // namespace plcgw
