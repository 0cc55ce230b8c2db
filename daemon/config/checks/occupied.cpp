#include "daemon/config/checks/occupied.hpp"

#include <algorithm>

namespace plcgw::config {

std::vector<std::string> occupied_devices::take(const std::string& plc, plc::place at, std::size_t bits,
                                                std::string who)
{
    runs& of = areas_[{plc, at.area}];
    std::vector<std::size_t> others;
    const std::size_t begin = at.bit - std::min(at.bit, of.longest);
    for (auto each = of.starts.lower_bound(begin); each != of.starts.end() && each->first < at.bit + bits; ++each)
        if (at.bit < each->first + each->second.bits)
            others.push_back(each->second.taker);
    std::sort(others.begin(), others.end());
    of.starts.emplace(at.bit, run{bits, takers_.size()});
    of.longest = std::max(of.longest, bits);
    takers_.push_back(std::move(who));

    std::vector<std::string> names;
    for (const std::size_t each : others)
        names.push_back(takers_[each]);
    return names;
}

}  // namespace plcgw::config
