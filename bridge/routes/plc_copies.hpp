// Devices that are copied from one PLC of the daemon to another, or within one, when they change.
#pragma once

#include "bridge/plc/simulated_plc.hpp"

#include <map>
#include <string>
#include <vector>

namespace plcgw {

struct plc_copy {
    std::string name;
    plc::simulated_plc* from = nullptr;
    plc::place first;  // of the source
    plc::simulated_plc* to = nullptr;
    plc::place at;  // of the target
    std::size_t bits{};
};

class plc_copies {
public:
    void add(plc_copy copy);
    const std::vector<plc_copy>& all() const { return copies_; }

    // Copies what of this change belongs to a source. A copy that comes back unchanged changes nothing, and so ends.
    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed) const;

private:
    using area_key = std::pair<const plc::simulated_plc*, std::size_t>;
    struct starts {
        std::multimap<std::size_t, std::size_t> by_first;
        std::size_t longest = 0;
    };

    std::vector<plc_copy> copies_;
    std::map<area_key, starts> areas_;
};

}  // namespace plcgw
