#include "daemon/config/checks/occupied.hpp"

#include <algorithm>

namespace plcgw::config {

std::vector<occupied_devices::run> occupied_devices::overlapping(const runs& of, std::size_t first,
                                                                 std::size_t bits) const
{
    std::vector<run> found;
    const std::size_t begin = first - std::min(first, of.longest);
    for (auto each = of.starts.lower_bound(begin); each != of.starts.end() && each->first < first + bits; ++each)
        if (first < each->first + each->second.bits)
            found.push_back(each->second);
    std::sort(found.begin(), found.end(), [](const run& a, const run& b) { return a.taker < b.taker; });
    return found;
}

std::vector<std::string> occupied_devices::take(const std::string& plc, plc::place at, std::size_t bits,
                                                std::string who, kind how, std::vector<std::size_t> cuts)
{
    runs& of = areas_[{plc, at.area}];
    std::vector<std::string> names;
    for (const run& each : overlapping(of, at.bit, bits))
        names.push_back(takers_[each.taker].who);
    of.starts.emplace(at.bit, run{at.bit, bits, takers_.size()});
    of.longest = std::max(of.longest, bits);
    takers_.push_back({std::move(who), how, std::move(cuts)});
    return names;
}

std::vector<occupied_devices::taken> occupied_devices::find(const std::string& plc, plc::place at,
                                                            std::size_t bits) const
{
    std::vector<taken> found;
    const auto of = areas_.find({plc, at.area});
    if (of == areas_.end())
        return found;
    for (const run& each : overlapping(of->second, at.bit, bits)) {
        const bool whole = each.first <= at.bit && at.bit + bits <= each.first + each.bits;
        const taker& by = takers_[each.taker];
        const auto cut = std::find_if(by.cuts.begin(), by.cuts.end(), [&](std::size_t c) {
            return each.first + c > at.bit && each.first + c < at.bit + bits;
        });
        found.push_back({by.who, whole, by.how, cut == by.cuts.end() ? std::nullopt : std::optional(*cut)});
    }
    return found;
}

}  // namespace plcgw::config
