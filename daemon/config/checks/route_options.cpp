#include "bridge/routes/route_status.hpp"
#include "daemon/config/checks/checks.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

// One for all registers or bits of a route, or one for each.
void check_values(check_context& c, const std::string& at, const std::vector<unsigned>& values, unsigned count,
                  bool are_bits)
{
    if (values.empty())
        c.complain(at, "is missing: one value for all registers or bits, or one for each");
    else if (values.size() != 1 && values.size() != count)
        c.complain(at, "has " + std::to_string(values.size()) + " values, expected one, or one for each of the " +
                           std::to_string(count));
    else if (are_bits && std::any_of(values.begin(), values.end(), [](unsigned each) { return each > 1; }))
        c.complain(at, "is for bits: give 0 or 1");
}

void check_loss(check_context& c, std::size_t i, const route_config& r, bool are_bits)
{
    if (r.on_loss != loss_policy::keep && !reads(r.way))
        c.complain(item("routes", i, "on_loss"),
                   "stands at a route that only writes: its memory is the writer's, there is nothing to lose");
    else if (r.on_loss == loss_policy::value)
        check_values(c, item("routes", i, "loss_value"), r.loss_value, r.count, are_bits);
    else if (!r.loss_value.empty())
        c.complain(item("routes", i, "loss_value"), "does nothing without \"on_loss\": \"value\"");
}

void check_upstream(check_context& c, std::size_t i, const route_config& r, bool are_bits)
{
    const upstream_config& u = r.upstream;
    const std::string at = item("routes", i, "upstream");
    if (u.longest_silence.count() == 0) {
        if (!u.safe.empty())
            c.complain(at + "/safe", "does nothing without \"longest_silence_ms\"");
        return;
    }
    if (reads(r.way))
        c.complain(at, "stands at a route that reads: safe values are for \"write\" and \"periodic-write\"");
    else
        check_values(c, at + "/safe", u.safe, r.count, are_bits);
}

}  // namespace

void check_status(check_context& c, device_check& devices, device_users& users, const std::string& row,
                  const std::string& plc, const status_config& s, std::size_t words, std::string who)
{
    if (!c.is_sound(row) || (s.device.empty() && s.plc.empty()))
        return;
    if (s.device.empty()) {
        c.complain(row + "/status", "lacks \"device\": the first of the status words");
        return;
    }
    if (plc.empty()) {
        c.complain(row + "/status", "lacks \"plc\": the PLC that shows it");
        return;
    }
    const std::string at = row + "/status/device";
    const auto place = devices.place_at(row + "/status/plc", at, plc, s.device, 16 * words);
    if (!place)
        return;
    devices.check_filled(at, plc, *place, 16 * words);
    for (const std::string& other : users.filled.take(plc, *place, 16 * words, std::move(who)))
        c.complain(at, "overlaps with the devices of " + other + ": each device has one source");
}

void check_route_options(check_context& c, device_check& devices, device_users& users, std::size_t i,
                         const route_config& r, std::size_t bits)
{
    const bool are_bits = bits == r.count;
    check_loss(c, i, r, are_bits);
    check_upstream(c, i, r, are_bits);
    check_status(c, devices, users, item("routes", i), r.status.plc.empty() ? r.plc : r.status.plc, r.status,
                 route_status_words, "the status of route \"" + r.name + "\"");
}

}  // namespace plcgw::config
