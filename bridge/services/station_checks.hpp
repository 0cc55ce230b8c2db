// What a serial station checks on a request before it carries it out, in the order of V1.1b3 section 7: function (01),
// whether it may be a broadcast, quantity and value (03). The address (02) is the memory's business.
#pragma once

#include "bridge/plc/modbus_error.hpp"
#include "protocols/modbus/request.hpp"

namespace plcgw {

enum class cast : std::uint8_t { to_one, to_all };

// Why a request is not carried out: what the client gets, and what the PLC's devices show (FX3 manual 12.6).
struct refusal {
    modbus::exception_code exception{};  // not sent when it was a broadcast
    plc::modbus_error error{};
    std::uint16_t detail = 0;
};

boost::system::result<modbus::request, refusal> accept_request(const plc::model& m, bytes pdu, cast to);

}  // namespace plcgw
