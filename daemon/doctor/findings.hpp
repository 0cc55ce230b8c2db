// What `plc-gateway doctor` finds: in plain words, and what to do about it.
#pragma once

#include "bridge/dds/discovery.hpp"

#include <string>
#include <vector>

namespace plcgw {

struct finding {
    enum class weight : std::uint8_t { good, note, bad } how{};
    std::string text;
    std::string cure;  // of a bad one
};

using findings = std::vector<finding>;

// What can be known without DDS. Nothing here waits longer than a second.
void look_at_cyclone_config(const dds_settings& settings, findings& found);
void look_at_interface(const dds_settings& settings, findings& found);
void look_at_ports(const dds_settings& settings, findings& found);
void look_at_peers(const dds_settings& settings, findings& found);

// Of those who were seen within so many seconds.
void look_at_participants(const dds_settings& settings, const std::vector<seen_participant>& seen, unsigned seconds,
                          findings& found);

}  // namespace plcgw
