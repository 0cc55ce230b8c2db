#include "daemon/config/checks/checks.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

constexpr std::size_t most_steps = 100'000;  // of all circles together

// Keys of a route that mean nothing for a copy.
std::string strange_key(const route_config& r)
{
    if (!r.station.empty())
        return "station";
    if (r.table)
        return "table";
    if (r.first)
        return "first";
    if (!r.source.empty())
        return "source";
    if (r.way != direction::read)
        return "direction";
    if (r.on_loss != loss_policy::keep)
        return "on_loss";
    if (!r.status.device.empty())
        return "status";
    return r.upstream.longest_silence.count() == 0 ? "" : "upstream";
}

}  // namespace

void copy_check::add(std::size_t i, const route_config& r)
{
    const std::string row = item("routes", i);
    if (!c_.is_sound(row))
        return;
    if (r.from.plc.empty() || r.from.device.empty()) {
        c_.complain(row + "/from", std::string("lacks \"") + (r.from.plc.empty() ? "plc" : "device") +
                                       "\": \"from\" needs a PLC and its first device");
        return;
    }
    if (const std::string key = strange_key(r); !key.empty())
        c_.complain(row + "/" + key, "stands beside \"from\": devices of a PLC are copied when they change, and need "
                                     "nothing else");
    const plc::model* const model = c_.model_of(r.from.plc);
    const auto source = model == nullptr ? std::nullopt : plc::parse_device(r.from.device, model->names);
    const std::size_t bits = source && plc::is_bit_kind(source->kind) ? r.count : std::size_t{16} * r.count;
    const auto from = devices_.place_at(row + "/from/plc", row + "/from/device", r.from.plc, r.from.device, bits);
    const auto to = devices_.place_of(row, r.plc, r.device, bits);
    if (!from || !to)
        return;
    devices_.check_filled(row + "/device", r.plc, *to, bits);
    for (const std::string& other : users_.filled.take(r.plc, *to, bits, "route \"" + r.name + "\""))
        c_.complain(row + "/device", "overlaps with the devices of " + other + ": each device has one source");
    copies_.push_back({i, {r.from.plc, from->area}, from->bit, {r.plc, to->area}, to->bit, bits});
}

// Follows what starts at `origin` and stands at `at` now. True when it comes back to the start at another device.
bool copy_check::shifts(const copy& start, const copy& last, std::size_t origin, std::size_t at, std::size_t bits,
                        std::size_t depth)
{
    if (last.to == start.from && at != origin && at < start.first + start.bits && start.first < at + bits)
        return true;
    if (depth == copies_.size() || ++steps_ > most_steps)
        return false;
    for (const copy& next : copies_) {
        const std::size_t first = std::max(at, next.first);
        const std::size_t end = std::min(at + bits, next.first + next.bits);
        if (next.from != last.to || first >= end)
            continue;
        const bool is_back = &next == &start && first - at + origin == first;
        if (!is_back && shifts(start, next, origin + first - at, next.at + first - next.first, end - first, depth + 1))
            return true;
    }
    return false;
}

void copy_check::check_circles()
{
    for (const copy& each : copies_)
        if (each.from == each.to && each.first == each.at)
            c_.complain(item("routes", each.route, "device"), "is where the copy comes from");
        else if (shifts(each, each, each.first, each.at, each.bits, 1))
            c_.complain(item("routes", each.route, "from"),
                        "is copied in a circle that comes back to other devices: each change would go on for ever");
}

}  // namespace plcgw::config
