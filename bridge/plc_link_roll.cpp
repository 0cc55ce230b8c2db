#include "bridge/plc_link_roll.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

void enter(plc_link_seen& row, time_point now, plc_link_state state)
{
    if (row.state != state)
        row.since = now;
    row.state = state;
}

}  // namespace

void plc_link_roll::heard(time_point now, const plc_link_area& area, plc_link_state state, std::string reason)
{
    const key who{area.station.station, area.sender.gateway, area.sender.member};
    auto found = stations_.find(who);
    if (found == stations_.end()) {
        make_room();
        if (stations_.size() >= most)
            return;
        found = stations_.try_emplace(who).first;
        found->second.since = now;
        found->second.state = state;
    }
    plc_link_seen& row = found->second;
    enter(row, now, state);
    row.station = area.station;
    row.gateway = area.sender.gateway;
    row.member = area.sender.member;
    row.reason = std::move(reason);
    row.heard = now;
}

void plc_link_roll::heard(time_point now, const plc_link_area& area)
{
    const auto found = stations_.find({area.station.station, area.sender.gateway, area.sender.member});
    if (found != stations_.end())
        found->second.heard = now;
}

void plc_link_roll::gone(time_point now, unsigned station, const std::string& gateway, const std::string& member)
{
    const auto found = stations_.find({station, gateway, member});
    if (found == stations_.end())
        return;
    enter(found->second, now, plc_link_state::gone);
    found->second.reason.clear();
}

// Who takes part stays: there are at most fifteen.
void plc_link_roll::make_room()
{
    if (stations_.size() < most)
        return;
    const auto is_older = [](const auto& a, const auto& b) {
        const bool a_stays = a.second.state == plc_link_state::active;
        const bool b_stays = b.second.state == plc_link_state::active;
        return std::pair(a_stays, a.second.heard) < std::pair(b_stays, b.second.heard);
    };
    const auto oldest = std::min_element(stations_.begin(), stations_.end(), is_older);
    if (oldest->second.state != plc_link_state::active)
        stations_.erase(oldest);
}

std::vector<plc_link_seen> plc_link_roll::seen(time_point now, duration given_up) const
{
    std::vector<plc_link_seen> all;
    for (const auto& [who, row] : stations_) {
        all.push_back(row);
        if (row.state == plc_link_state::refused && now >= row.heard + given_up) {
            all.back().state = plc_link_state::gone;
            all.back().since = row.heard + given_up;
            all.back().reason.clear();
        }
    }
    return all;
}

}  // namespace plcgw
