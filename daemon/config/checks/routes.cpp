#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {
namespace {

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
    devices.check_filled(item("routes", i, "device"), r.plc, *at, bits);
    for (const std::string& other : occupied.take(r.plc, *at, bits, "route \"" + r.name + "\""))
        c.complain(item("routes", i, "device"),
                   "overlaps with the devices of " + other + ": each device has one source");
}

}  // namespace

void check_routes(check_context& c, device_check& devices, occupied_devices& occupied)
{
    for (std::size_t i = 0; i < c.config.routes.size(); ++i)
        check_route(c, devices, occupied, i, c.config.routes[i]);
}

}  // namespace plcgw::config
