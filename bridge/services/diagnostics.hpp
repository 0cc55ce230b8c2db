// The functions of a serial server that are not about memory: 07, 08, 0B, 0C and 11 (FX3 manual 7.10 to 7.13 and 7.16).
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/services/comm_counters.hpp"
#include "bridge/services/event_log.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw {

// What these functions tell about. They only read it: what a diagnostic does is the station's business.
struct diagnosed {
    const plc::simulated_plc& plc;
    const plc::channel& channel;
    const comm_counters& counters;
    const event_log& log;
};

modbus::response serve(const diagnosed& d, const modbus::read_exception_status& r);
modbus::response serve(const diagnosed& d, const modbus::diagnostics& r);
modbus::response serve(const diagnosed& d, const modbus::get_comm_event_counter& r);
modbus::response serve(const diagnosed& d, const modbus::get_comm_event_log& r);
modbus::response serve(const diagnosed& d, const modbus::report_server_id& r);

// M8060-M8067 as one byte, M8438 in place of M8063 on channel 2.
std::uint8_t diagnostic_byte(const diagnosed& d);

}  // namespace plcgw
