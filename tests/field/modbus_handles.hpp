// libmodbus objects that free themselves. Freeing a context does not close its descriptor.
#pragma once

#include <modbus.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace plcgw::field {

struct free_modbus {
    void operator()(modbus_t* context) const { modbus_free(context); }
    void operator()(modbus_mapping_t* registers) const { modbus_mapping_free(registers); }
};
using modbus_context = std::unique_ptr<modbus_t, free_modbus>;
using modbus_registers = std::unique_ptr<modbus_mapping_t, free_modbus>;

using request_buffer = std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH>;
using request = std::span<const std::uint8_t>;  // as modbus_receive() leaves it; empty: nothing to answer

}  // namespace plcgw::field
