#include "daemon/config/checks/checks.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

// The devices that read routes fill, by PLC, area and first bit.
class occupied_devices {
public:
    // The routes that fill some of these devices already, in the order of the configuration.
    std::vector<std::size_t> take(const std::string& plc, plc::place at, std::size_t bits, std::size_t route)
    {
        runs& of = areas_[{plc, at.area}];
        std::vector<std::size_t> others;
        const std::size_t begin = at.bit - std::min(at.bit, of.longest);
        for (auto each = of.starts.lower_bound(begin); each != of.starts.end() && each->first < at.bit + bits; ++each)
            if (at.bit < each->first + each->second.bits)
                others.push_back(each->second.route);
        std::sort(others.begin(), others.end());
        of.starts.emplace(at.bit, run{bits, route});
        of.longest = std::max(of.longest, bits);
        return others;
    }

private:
    struct run {
        std::size_t bits;
        std::size_t route;
    };
    struct runs {
        std::multimap<std::size_t, run> starts;
        std::size_t longest = 0;
    };
    std::map<std::pair<std::string, std::size_t>, runs> areas_;
};

void check_route(check_context& c, device_check& devices, occupied_devices& occupied, std::size_t i,
                 const route_config& r)
{
    const auto* const from = c.station(r.station, item("routes", i, "station"));
    const auto* const line = from == nullptr ? nullptr : c.lines.find(from->line);
    if (!c.is_sound(item("routes", i))) {
        devices.place_of(item("routes", i), r.plc, r.device, 1);
        return;
    }
    if (from != nullptr && from->unit == 0 && r.way == direction::read)
        c.complain(item("routes", i, "station"),
                   "is unit 0, the broadcast: nobody answers, only write routes can use it");
    const std::size_t bits = check_station_place(c, i, r, line);
    const auto at = devices.place_of(item("routes", i), r.plc, r.device, bits);
    if (!at || r.way != direction::read)
        return;
    devices.check_filled(item("routes", i), r.plc, *at, bits);
    for (const std::size_t other : occupied.take(r.plc, *at, bits, i))
        c.complain(item("routes", i, "device"), "overlaps with the devices of route \"" + c.config.routes[other].name +
                                                    "\": each device has one source");
}

}  // namespace

void check_routes(check_context& c)
{
    device_check devices(c);
    occupied_devices occupied;
    for (std::size_t i = 0; i < c.config.routes.size(); ++i)
        check_route(c, devices, occupied, i, c.config.routes[i]);
}

}  // namespace plcgw::config
