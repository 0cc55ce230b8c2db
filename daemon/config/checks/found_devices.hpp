// Devices of a PLC as somebody wrote them in the configuration: what is wrong with them, as text for the engineer.
#pragma once

#include "bridge/plc/memory.hpp"

#include <string>

namespace plcgw::config {

struct found_devices {
    std::optional<plc::place> at;  // nothing when there is a mistake, or no model to ask
    std::string mistake;           // empty when there is none
};

found_devices find_devices(const plc::memory& memory, const std::string& device, std::size_t bits);

// Of a PLC that does not exist: then only what no model can read is a mistake.
found_devices find_devices(const std::string& device);

// Empty, or why nothing may be routed to there: a PLC shows its own communication in these devices.
std::string status_mistake(const plc::memory& memory, plc::place at, std::size_t bits);

}  // namespace plcgw::config
