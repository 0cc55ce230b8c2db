// Internal to bridge/dds: requested against offered QoS (DDS 1.4, 2.2.3), as far as the topics here use it.
#pragma once

#include <string>
#include <vector>

struct dds_qos;

namespace plcgw {

// Ownership is not looked at: subscribers here hear gateways alone and pairs.
std::vector<std::string> incompatible_policies(const dds_qos* offered, const dds_qos* requested);
std::vector<std::string> partitions_of(const dds_qos* qos);

}  // namespace plcgw
