// What one station of a PLC link says, as it travels between gateways.
#pragma once

#include "bridge/plc_link.hpp"
#include "protocols/time.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace plcgw {

// A gateway's process: another one after each start.
struct plc_link_sender {
    std::string gateway;
    std::string member;
    wall_time started{};
    bool operator==(const plc_link_sender&) const = default;
};

struct plc_link_area {
    std::string link;
    plc_link_sender sender;
    plc_link_station station;  // its counts are those of the words below
    std::uint64_t sequence{};  // +1 with each that is sent
    wall_time source{};
    std::vector<std::uint16_t> relays;     // from settings.relay_first on
    std::vector<std::uint16_t> registers;  // from settings.register_first on
};

// Nobody sends this station's words any more.
struct plc_link_gone {
    std::string link;
    std::string gateway;
    std::string member;
    unsigned station{};
};

using plc_link_news = std::variant<plc_link_area, plc_link_gone>;

}  // namespace plcgw
