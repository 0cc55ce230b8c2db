#include "daemon/config/checks/checks.hpp"
#include "daemon/config/checks/found_devices.hpp"

namespace plcgw::config {

const plc::memory& device_check::memory_of(const plc::model& model)
{
    return memories_.try_emplace(&model, model).first->second;
}

std::optional<plc::place> device_check::place_of(const std::string& row, const std::string& plc,
                                                 const std::string& device, std::size_t bits)
{
    c_.plc(plc, row + "/plc");
    const plc::model* const model = c_.model_of(plc);
    found_devices found = model == nullptr ? find_devices(device) : find_devices(memory_of(*model), device, bits);
    if (!found.mistake.empty())
        c_.complain(row + "/device", std::move(found.mistake));
    return found.at;
}

void device_check::check_filled(const std::string& row, const std::string& plc, plc::place at, std::size_t bits)
{
    std::string why = status_mistake(memory_of(*c_.model_of(plc)), at, bits);
    if (!why.empty())
        c_.complain(row + "/device", std::move(why));
}

}  // namespace plcgw::config
