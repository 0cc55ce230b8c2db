// The registers of a simulated device, and values that are written into them.
#pragma once

#include "tests/field/modbus_handles.hpp"

#include <cstdint>
#include <string>

namespace plcgw::field {

inline constexpr int register_count = 1000;  // of each table, from address 0
inline constexpr int answers_address = 998;  // input registers 998-999 count the requests that were answered

modbus_registers make_registers();

std::uint16_t word(double value);  // rounded, and kept within 0 to 65535

// Two registers, high word first ("ABCD").
void set_long(std::uint16_t* registers, std::uint32_t value);
void set_float(std::uint16_t* registers, double value);

// "hr:0=1234": table (co, di, hr or ir), address and value. Throws std::invalid_argument.
void set_register(modbus_mapping_t& registers, const std::string& assignment);

}  // namespace plcgw::field
