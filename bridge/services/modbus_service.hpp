// MODBUS requests on the memory of a simulated PLC. The order of checks is the specification's: function (01), quantity
// and value (03), address (02). Nothing is written unless all of it can be.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw {

modbus::response serve(plc::simulated_plc& plc, const modbus::request& question);

// A request PDU answered by a response PDU, for servers. Never empty.
buffer serve_pdu(plc::simulated_plc& plc, bytes pdu);

}  // namespace plcgw
