#include "daemon/config/checks/found_devices.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

bool is_device_of_some_model(const std::string& text)
{
    const auto models = plc::all_models();
    return std::any_of(models.begin(), models.end(),
                       [&](const plc::model* each) { return plc::parse_device(text, each->names).has_value(); });
}

found_devices mistaken(std::string what) { return {std::nullopt, std::move(what)}; }

found_devices unreadable(const plc::model& model, const std::string& device)
{
    return mistaken("is \"" + device + "\", expected a device such as " + std::string(model.examples));
}

}  // namespace

found_devices find_devices(const std::string& device)
{
    if (device.empty() || is_device_of_some_model(device))
        return {};
    return unreadable(*plc::all_models().front(), device);
}

found_devices find_devices(const plc::memory& memory, const std::string& device, std::size_t bits)
{
    if (device.empty())
        return {};
    const plc::model& model = memory.model();
    const auto parsed = plc::parse_device(device, model.names);
    if (!parsed)
        return unreadable(model, device);
    const std::string name = plc::to_string(*parsed, model.names);
    const auto at = memory.find(*parsed);
    if (!at || !plc::exists(model, *parsed))
        return mistaken("is " + name + ", which a " + std::string(model.name) + " does not have");
    if (memory.bits_from(*at) >= bits)
        return {at, {}};
    const plc::area& area = model.areas[at->area];
    const std::size_t devices = std::size_t{area.count} * area.bits_per_device / plc::bits_of(area, parsed->kind);
    const plc::device last{parsed->kind, area.first + static_cast<std::uint32_t>(devices) - 1};
    return mistaken("is " + name + ", but from there the count goes beyond " + plc::to_string(last, model.names) +
                    ", the last one");
}

std::string status_mistake(const plc::memory& memory, plc::place at, std::size_t bits)
{
    const plc::model& model = memory.model();
    for (const plc::device_run& run : model.status) {
        const plc::place first = *memory.find(run.first);
        const std::size_t size = run.count * plc::bits_of(model.areas[first.area], run.first.kind);
        if (!plc::overlaps({first.area, first.bit, size}, at, bits))
            continue;
        const plc::device last{run.first.kind, run.first.number + run.count - 1};
        return "reaches into " + plc::to_string(run.first, model.names) + "-" + plc::to_string(last, model.names) +
               ", where a " + std::string(model.name) + " shows its own communication: choose other devices";
    }
    return {};
}

}  // namespace plcgw::config
