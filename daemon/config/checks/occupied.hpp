// The devices that something fills, by PLC, area and first bit: each device has one source.
#pragma once

#include "bridge/plc/memory.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace plcgw::config {

class occupied_devices {
public:
    // who: 'route "pump.values"'. Gives those that fill some of these devices already, in the order of their taking.
    std::vector<std::string> take(const std::string& plc, plc::place at, std::size_t bits, std::string who);

private:
    struct run {
        std::size_t bits;
        std::size_t taker;
    };
    struct runs {
        std::multimap<std::size_t, run> starts;
        std::size_t longest = 0;
    };
    std::map<std::pair<std::string, std::size_t>, runs> areas_;
    std::vector<std::string> takers_;
};

}  // namespace plcgw::config
