// The devices that something fills, by PLC, area and first bit: each device has one source.
#pragma once

#include "bridge/plc/memory.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plcgw::config {

class occupied_devices {
public:
    // Others may write there as well: the taker sends to its station what they write.
    enum class kind : std::uint8_t { only_source, shared };

    // who: 'route "pump.values"'. Gives those that fill some of these devices already, in the order of their taking.
    // cuts: bits, counted from the first, before and behind which the devices come at different times.
    std::vector<std::string> take(const std::string& plc, plc::place at, std::size_t bits, std::string who,
                                  kind how = kind::only_source, std::vector<std::size_t> cuts = {});

    struct taken {
        std::string who;
        bool whole{};  // all of the devices asked for are among its own
        kind how{};
        std::optional<std::size_t> cut{};  // among the devices asked for: the taker's bit
    };
    std::vector<taken> find(const std::string& plc, plc::place at, std::size_t bits) const;

private:
    struct run {
        std::size_t first;
        std::size_t bits;
        std::size_t taker;
    };
    struct runs {
        std::multimap<std::size_t, run> starts;
        std::size_t longest = 0;
    };
    struct taker {
        std::string who;
        kind how;
        std::vector<std::size_t> cuts;
    };
    std::vector<run> overlapping(const runs& of, std::size_t first, std::size_t bits) const;

    std::map<std::pair<std::string, std::size_t>, runs> areas_;
    std::vector<taker> takers_;
};

}  // namespace plcgw::config
