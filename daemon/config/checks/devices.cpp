#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

std::optional<plc::place> device_check::place_of(const std::string& row, const std::string& plc,
                                                 const std::string& device, std::size_t bits)
{
    return place_at(row + "/plc", row + "/device", plc, device, bits);
}

std::optional<plc::place> device_check::place_at(const std::string& plc_at, const std::string& device_at,
                                                 const std::string& plc, const std::string& device, std::size_t bits)
{
    const plc_config* const owner = c_.plc(plc, plc_at);
    const plc::model* const model = owner == nullptr ? nullptr : plc::find_model(owner->model);
    const auto parsed = plc::parse_device(device);
    if (!parsed && !device.empty())
        c_.complain(device_at, "is \"" + device + "\", expected a device such as D100, M0 or X17 (octal)");
    if (!parsed || model == nullptr)
        return std::nullopt;
    const plc::memory& memory = memories_.try_emplace(model, *model).first->second;
    const auto at = memory.find(*parsed);
    if (!at || !plc::exists(*model, *parsed)) {
        c_.complain(device_at,
                    "is " + plc::to_string(*parsed) + ", which a " + std::string(model->name) + " does not have");
        return std::nullopt;
    }
    if (memory.bits_from(*at) < bits) {
        const plc::area& area = model->areas[at->area];
        const plc::device last{area.kind, area.first + area.count - 1};
        c_.complain(device_at, "is " + plc::to_string(*parsed) + ", but from there the count goes beyond " +
                                   plc::to_string(last) + ", the last one");
        return std::nullopt;
    }
    return at;
}

}  // namespace plcgw::config
