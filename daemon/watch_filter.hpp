// Which events `plc-gateway watch` shows.
#pragma once

#include "bridge/dds/event.hpp"
#include "bridge/dds/topics.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace plcgw {

// Empty: all. What is given has to fit, one of each kind; the status of a gateway and its end pass the names.
struct watch_filter {
    std::vector<std::string> gateways;
    std::vector<std::string> names;  // beginnings: of routes, blocks, points, lines, ports, devices, subjects of events
    std::vector<dds_topic> topics;

    // A device of a PLC, "D100": what a configuration puts over it, whose names are these; or without a configuration
    // the blocks that are named after devices.
    bool by_device = false;
    std::set<std::string> over_device;
    std::string block_prefix;  // "main." of "main.D100"
    std::string area;          // "D"
    std::uint32_t number = 0;
};

// "PortStatus", "port_status" or "portstatus"; nothing: no topic.
std::optional<dds_topic> topic_from(const std::string& text);

bool fits(const watch_filter& filter, const dds_event& event);

// What ends `watch --count`: samples of the chosen topics; of registers and points when none is chosen.
bool is_counted(const watch_filter& filter, const dds_event& event);

}  // namespace plcgw
