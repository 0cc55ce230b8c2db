#include "protocols/modbus/types.hpp"

namespace plcgw::modbus {

std::string_view to_string(exception_code e)
{
    switch (e) {
    case exception_code::illegal_function: return "illegal function";
    case exception_code::illegal_data_address: return "illegal data address";
    case exception_code::illegal_data_value: return "illegal data value";
    case exception_code::server_device_failure: return "server device failure";
    case exception_code::acknowledge: return "acknowledge";
    case exception_code::server_device_busy: return "server device busy";
    case exception_code::memory_parity_error: return "memory parity error";
    case exception_code::gateway_path_unavailable: return "gateway path unavailable";
    case exception_code::gateway_target_failed_to_respond: return "gateway target device failed to respond";
    }
    return "unknown exception";
}

std::string_view to_string(table t)
{
    switch (t) {
    case table::coils: return "coil";
    case table::discrete_inputs: return "discrete";
    case table::input_registers: return "input";
    case table::holding_registers: return "holding";
    }
    return "unknown";
}

}  // namespace plcgw::modbus
