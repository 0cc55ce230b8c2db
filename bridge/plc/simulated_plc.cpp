#include "bridge/plc/simulated_plc.hpp"

namespace plcgw::plc {
namespace {

// FX3 manual 12.5 and 12.6, channel 1.
constexpr std::uint16_t modbus_error_in_d8063 = 6321;
constexpr std::uint16_t invalid_parameter_setup = 202;

}  // namespace

simulated_plc::simulated_plc(std::string name, const plc::model& m, setup_program program)
    : name_(std::move(name)), program_(std::move(program)), memory_(m), map_(modbus_map::standard(m))
{
    power_on();
}

void simulated_plc::power_on()
{
    allocation sets{};
    for (const auto& [number, value] : program_.registers)
        if (number >= allocation_first)
            sets[number - allocation_first] = value;

    if (model().user_defined_map) {
        std::optional<allocation_fault> invalid;
        map_ = modbus_map::user_defined(model(), sets, invalid);
        if (invalid && !program_.fault) {
            const auto at = program_.lines.find(invalid->detail);
            program_.fault = parameter_fault{invalid->detail, at == program_.lines.end() ? 0 : at->second,
                                             std::move(invalid->reason)};
        }
    }
    for (const auto& [number, value] : program_.registers)
        set_special(device_kind::d, number, number >= allocation_first ? sets[number - allocation_first] : value);

    set_special(device_kind::m, 8000, 1);  // RUN monitor, normally on
    if (program_.fault) {
        set_special(device_kind::m, 8063, 1);
        set_special(device_kind::d, 8063, modbus_error_in_d8063);
        set_special(device_kind::m, 8402, 1);
        set_special(device_kind::m, 8403, 1);
        set_special(device_kind::d, 8402, invalid_parameter_setup);
        set_special(device_kind::d, 8403, static_cast<std::uint16_t>(program_.fault->detail));
    }
}

void simulated_plc::set_special(device_kind kind, std::uint32_t number, std::uint16_t value)
{
    const auto at = memory_.find({kind, number});
    if (!at)
        return;  // this model has no such register
    if (is_bit_kind(kind))
        memory_.set_bit(*at, value != 0);
    else
        memory_.set_word(*at, value);
}

}  // namespace plcgw::plc
