// Function 2B, MEI type 0E: what a simulated PLC says about itself over TCP. V1.1b3 section 6.21.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "protocols/modbus/response.hpp"

#include <string_view>

namespace plcgw {

// Basic: vendor "plc-gateway", product code = the model's name, revision. Regular: model name, user application name =
// the PLC's name. Exception 02 when one object is asked for that does not exist.
modbus::response identify(const plc::simulated_plc& plc, std::string_view revision,
                          const modbus::read_device_identification& r);

}  // namespace plcgw
