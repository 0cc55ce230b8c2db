// MODBUS requests on the memory of a simulated PLC. The order of checks is the specification's: function (01), quantity
// and value (03), address (02). Nothing is written unless all of it can be.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw {

// Functions that are not about memory (07, 08, 0B, 0C, 11) belong to a serial station: exception 01 here.
modbus::response serve(plc::simulated_plc& plc, const modbus::request& question);

// A request PDU answered by a response PDU, for servers on TCP. Never empty.
buffer serve_pdu(plc::simulated_plc& plc, bytes pdu);

// The same with function 2B/0E, for which one must know the gateway's own revision.
buffer serve_pdu(plc::simulated_plc& plc, bytes pdu, std::string_view revision);

}  // namespace plcgw
