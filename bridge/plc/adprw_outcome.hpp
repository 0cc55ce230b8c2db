// How an exchange that an ADPRW asked for ended, in the words of FX3 manual 12.6.
#pragma once

#include "bridge/plc/modbus_error.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw::plc {

struct adprw_failure {
    modbus_error code{};      // invalid_hardware: the port is not there
    std::uint8_t received{};  // of a mismatch: the unit or function code that answered
    bool operator==(const adprw_failure&) const = default;
};

// no_response: a broadcast was sent, or "force listen only". An exception is an answer too (error 212).
using adprw_outcome = std::variant<modbus::response, adprw_failure>;

// What a client's error stands for. `received`: the whole frame that did not fit, where there was one.
adprw_failure failure_of(boost::system::error_code why, modbus::unit_id unit, const modbus::request& asked,
                         const std::optional<modbus::frame>& received = {});

}  // namespace plcgw::plc
