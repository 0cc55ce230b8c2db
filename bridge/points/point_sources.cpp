#include "bridge/points/point_sources.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned most_copies = 8;  // of copies in a row

}  // namespace

void point_sources::add(std::string name, const device_span& filled, say state)
{
    const auto index = static_cast<std::uint32_t>(sources_.size());
    sources_.push_back({filled, std::move(state)});
    starts& of = areas_[{filled.plc, filled.at.area}];
    of.by_first.emplace(filled.at.bit, index);
    of.longest = std::max(of.longest, filled.bits);
    by_name_.emplace(std::move(name), index);
}

void point_sources::add_copy(const device_span& from, const device_span& to) { copies_.push_back({from, to}); }

std::vector<std::uint32_t> point_sources::named(const std::string& name) const
{
    std::vector<std::uint32_t> all;
    const auto [begin, end] = by_name_.equal_range(name);
    for (auto each = begin; each != end; ++each)
        all.push_back(each->second);
    return all;
}

std::vector<std::uint32_t> point_sources::find(const device_span& devices) const
{
    std::vector<std::uint32_t> found;
    find(devices, most_copies, found);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void point_sources::find(const device_span& devices, unsigned copies_left, std::vector<std::uint32_t>& found) const
{
    const std::size_t end = devices.at.bit + devices.bits;
    if (const auto area = areas_.find({devices.plc, devices.at.area}); area != areas_.end()) {
        const std::size_t begin = devices.at.bit - std::min(devices.at.bit, area->second.longest);
        const auto& by_first = area->second.by_first;
        for (auto each = by_first.lower_bound(begin); each != by_first.end() && each->first < end; ++each)
            if (each->first + sources_[each->second].filled.bits > devices.at.bit)
                found.push_back(each->second);
    }
    for (const copied& each : copies_) {
        if (copies_left == 0 || each.to.plc != devices.plc || each.to.at.area != devices.at.area)
            continue;
        const std::size_t first = std::max(each.to.at.bit, devices.at.bit);
        const std::size_t last = std::min(each.to.at.bit + each.to.bits, end);
        if (first >= last)
            continue;
        const plc::place behind{each.from.at.area, each.from.at.bit + first - each.to.at.bit};
        find({each.from.plc, behind, last - first}, copies_left - 1, found);
    }
}

source_state point_sources::of(const std::vector<std::uint32_t>& which) const
{
    source_state worst;
    for (const std::uint32_t each : which) {
        const source_state now = sources_[each].state();
        if (worst.state == quality::good)
            worst.state = now.state;
        if (each == which.front() || now.source < worst.source)
            worst.source = now.source;
    }
    return worst;
}

}  // namespace plcgw
