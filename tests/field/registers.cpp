#include "tests/field/registers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>

namespace plcgw::field {

modbus_registers make_registers()
{
    modbus_registers made(modbus_mapping_new(register_count, register_count, register_count, register_count));
    if (!made)
        throw std::bad_alloc();
    return made;
}

std::uint16_t word(double value) { return static_cast<std::uint16_t>(std::clamp(std::lround(value), 0L, 65535L)); }

void set_long(std::uint16_t* registers, std::uint32_t value)
{
    registers[0] = static_cast<std::uint16_t>(value >> 16);
    registers[1] = static_cast<std::uint16_t>(value & 0xFFFF);
}

void set_float(std::uint16_t* registers, double value)
{
    // Not modbus_set_float_abcd(): what libmodbus 3.1.6 writes with it is BADC (its issue 611).
    set_long(registers, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void set_register(modbus_mapping_t& registers, const std::string& assignment)
{
    char table[3] = {};
    unsigned address = 0, value = 0;
    char rest = 0;
    const int fields = std::sscanf(assignment.c_str(), "%2[a-z]:%u=%u%c", table, &address, &value, &rest);
    if (fields != 3 || address >= register_count || value > 0xFFFF)
        throw std::invalid_argument(assignment + " is not like hr:0=1234");

    const std::string name = table;
    const auto bit = static_cast<std::uint8_t>(value != 0);
    if (name == "co")
        registers.tab_bits[address] = bit;
    else if (name == "di")
        registers.tab_input_bits[address] = bit;
    else if (name == "hr")
        registers.tab_registers[address] = static_cast<std::uint16_t>(value);
    else if (name == "ir")
        registers.tab_input_registers[address] = static_cast<std::uint16_t>(value);
    else
        throw std::invalid_argument(assignment + ": the tables are co, di, hr and ir");
}

}  // namespace plcgw::field
