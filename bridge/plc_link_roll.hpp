// The stations of a PLC link as one PLC sees them, for those who ask: who takes part, who is refused and why, who is
// gone. The manual names no relays for that.
#pragma once

#include "bridge/plc_link_area.hpp"

#include <map>
#include <tuple>

namespace plcgw {

enum class plc_link_state : std::uint8_t { active, refused, gone };

struct plc_link_seen {
    plc_link_station station;
    std::string gateway;
    std::string member;
    plc_link_state state{};
    std::string reason;  // why it is refused; of one that takes part: what does not fit all the same; or empty
    time_point since{};  // it is in this state
    time_point heard{};  // last
};

class plc_link_roll {
public:
    // Heard now. A foreign network may make up any number of names: those beyond `most` push out one that does not take
    // part, or are not kept.
    void heard(time_point now, const plc_link_area& area, plc_link_state state, std::string reason);
    void heard(time_point now, const plc_link_area& area);  // as before
    void gone(time_point now, unsigned station, const std::string& gateway, const std::string& member);

    // By station number. Who was refused and is not heard for `given_up` is gone, too.
    std::vector<plc_link_seen> seen(time_point now, duration given_up) const;

    void clear() { stations_.clear(); }

    static constexpr std::size_t most = 64;

private:
    using key = std::tuple<unsigned, std::string, std::string>;  // station, gateway, member

    void make_room();

    std::map<key, plc_link_seen> stations_;
};

}  // namespace plcgw
