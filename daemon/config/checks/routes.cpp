#include "bridge/routes/route_status.hpp"
#include "daemon/config/checks/checks.hpp"
#include "daemon/config/checks/route_cuts.hpp"

namespace plcgw::config {
namespace {

bool is_copy(const route_config& r) { return !r.from.plc.empty() || !r.from.device.empty(); }

void check_route(check_context& c, device_check& devices, device_users& users, std::size_t i, const route_config& r)
{
    const auto* const from = c.station(r.station, item("routes", i, "station"));
    const auto* const line = from == nullptr ? nullptr : c.lines.find(from->line);
    if (!c.is_sound(item("routes", i))) {
        devices.place_of(item("routes", i), r.plc, r.device, 1);
        return;
    }
    if (r.station.empty())
        c.complain(item("routes", i), "lacks \"station\": the name of a station, or \"from\": devices of a PLC");
    if (from != nullptr && from->unit == 0 && reads(r.way))
        c.complain(item("routes", i, "station"),
                   "is unit 0, the broadcast: nobody answers, only write routes can use it");
    const std::size_t bits = r.station.empty() ? 1 : check_station_place(c, i, r, line);
    const auto at = devices.place_of(item("routes", i), r.plc, r.device, bits);
    check_route_options(c, devices, users, i, r, bits);
    if (!at)
        return;
    const std::string who = "route \"" + r.name + "\"";
    if (writes(r.way))
        users.sent.take(r.plc, *at, bits, who, {}, cuts_of(r, line, direction::write));
    if (!reads(r.way))
        return;
    devices.check_filled(item("routes", i, "device"), r.plc, *at, bits);
    const auto how = writes(r.way) ? occupied_devices::kind::shared : occupied_devices::kind::only_source;
    for (const std::string& other : users.filled.take(r.plc, *at, bits, who, how, cuts_of(r, line, direction::read)))
        c.complain(item("routes", i, "device"),
                   "overlaps with the devices of " + other + ": each device has one source");
}

}  // namespace

void check_routes(check_context& c, device_check& devices, device_users& users)
{
    copy_check copies(c, devices, users);
    for (std::size_t i = 0; i < c.config.routes.size(); ++i) {
        const route_config& r = c.config.routes[i];
        if (is_copy(r))
            copies.add(i, r);
        else
            check_route(c, devices, users, i, r);
    }
    copies.check_circles();
    for (std::size_t i = 0; i < c.config.stations.size(); ++i) {
        const station_config& s = c.config.stations[i];
        check_status(c, devices, users, item("stations", i), s.status.plc, s.status, station_status_words,
                     "the status of station \"" + s.name + "\"");
    }
}

}  // namespace plcgw::config
