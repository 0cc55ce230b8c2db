// MODBUS requests to a station that speaks MEWTOCOL: which devices they mean, by the map of an FP7 (FP7 manual 8.2.1),
// and what its answers are in MODBUS.
#pragma once

#include "protocols/mewtocol/block.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw {

// The blocks to be asked, in their order. Exception 02 for what the map does not have, 01 for functions that are
// neither reads nor writes of it. Function 16H is one of these: over MEWTOCOL it would be a read and a write, with the
// station's program between them.
boost::system::result<std::vector<mewtocol::block>, modbus::exception_code> blocks_of(const modbus::request& question);

// answers: of the blocks in their order; an error code is the last one.
modbus::response modbus_answer(const modbus::request& question, const std::vector<mewtocol::response>& answers);

// V1.1b3 chapter 7: 02 where the station has no such device, 06 while it is busy, 01 for a command that it does not
// know, 04 for everything else.
modbus::exception_code exception_of(mewtocol::error_code refused);

}  // namespace plcgw
