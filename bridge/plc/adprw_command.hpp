// What an ADPRW asks at this moment, and where its answer goes: FX3 manual 8.3.
#pragma once

#include "bridge/plc/adprw_operands.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw::plc {

struct adprw_command {
    modbus::unit_id unit{};
    modbus::request request;
    std::optional<place> target;  // what comes back goes to the devices from here on
};

boost::system::result<adprw_command, operand_fault> evaluate(const adprw& of, const memory& devices);

// Of a word device, only the bits that were asked for change (FX3 manual 10.4). False when the answer does not fit the
// request: then nothing is written.
bool store_answer(const adprw_command& asked, const modbus::response& answer, memory& devices);

}  // namespace plcgw::plc
