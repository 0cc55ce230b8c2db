// The functions that the models answer. FX3 manual 7.1, LS manual 5-1 and 7-1.
#pragma once

#include "protocols/modbus/types.hpp"

namespace plcgw::plc {

// FX3S, FX3G and FX3GC have the eight basic ones.
inline constexpr modbus::function basic_functions[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
};

inline constexpr modbus::function fx3u_functions[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::read_exception_status,
    modbus::function::diagnostics,
    modbus::function::get_comm_event_counter,
    modbus::function::get_comm_event_log,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
    modbus::function::report_server_id,
    modbus::function::mask_write_register,
    modbus::function::read_write_multiple_registers,
};

inline constexpr modbus::function ls_functions[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
    modbus::function::read_write_multiple_registers,
};

// Over TCP, which no manual describes: what a list above has about memory, and the device identification that TCP users
// expect. Functions 07, 08, 0B, 0C and 11 belong to a serial line (V1.1b3 sections 6.7 to 6.10, 6.13).
inline constexpr modbus::function basic_functions_over_tcp[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
    modbus::function::encapsulated_interface,
};

inline constexpr modbus::function fx3u_functions_over_tcp[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
    modbus::function::mask_write_register,
    modbus::function::read_write_multiple_registers,
    modbus::function::encapsulated_interface,
};

inline constexpr modbus::function ls_functions_over_tcp[] = {
    modbus::function::read_coils,
    modbus::function::read_discrete_inputs,
    modbus::function::read_holding_registers,
    modbus::function::read_input_registers,
    modbus::function::write_single_coil,
    modbus::function::write_single_register,
    modbus::function::write_multiple_coils,
    modbus::function::write_multiple_registers,
    modbus::function::read_write_multiple_registers,
    modbus::function::encapsulated_interface,
};

}  // namespace plcgw::plc
