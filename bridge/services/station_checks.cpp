#include "bridge/services/station_checks.hpp"

#include "protocols/modbus/wire.hpp"

namespace plcgw {
namespace {

using modbus::diagnostic;
using modbus::exception_code;
using modbus::function;
using plc::modbus_error;

// The column "Broadcast" of FX3 manual 7.1. A sub-function that does not exist is not judged here.
bool is_refused_as_broadcast(bytes pdu)
{
    switch (function{pdu[0]}) {
    case function::write_single_coil:
    case function::write_single_register:
    case function::write_multiple_coils:
    case function::write_multiple_registers:
    case function::mask_write_register: return false;
    case function::diagnostics: break;
    default: return true;
    }
    if (pdu.size() < 3)
        return false;
    const std::uint16_t sub = modbus::read_word(pdu, 1);
    const auto is = [sub](diagnostic what) { return sub == static_cast<std::uint16_t>(what); };
    return is(diagnostic::return_query_data) || is(diagnostic::return_diagnostic_register) ||
           (sub >= static_cast<std::uint16_t>(diagnostic::bus_message_count) &&
            sub <= static_cast<std::uint16_t>(diagnostic::bus_character_overrun_count));
}

// Details of error 0215: high byte 0 and the function, or 08 and the sub-function.
std::uint16_t broadcast_detail(bytes pdu)
{
    if (function{pdu[0]} != function::diagnostics)
        return pdu[0];
    return static_cast<std::uint16_t>(pdu[0] << 8 | pdu[2]);
}

// Exception 03 is error 0216 when a value is wrong, 0207 when a length or a count is (12.6). Of a request with the
// right length only these two functions have a value that can be wrong.
modbus_error error_of_value(bytes pdu)
{
    const bool has_value = function{pdu[0]} == function::write_single_coil || function{pdu[0]} == function::diagnostics;
    return has_value && pdu.size() == 5 ? modbus_error::illegal_value : modbus_error::length_mismatch;
}

}  // namespace

boost::system::result<modbus::request, refusal> accept_request(const plc::model& m, bytes pdu, cast to)
{
    constexpr refusal unsupported{exception_code::illegal_function, modbus_error::unsupported_function};
    if (!plc::answers(m, function{pdu[0]}, plc::transport::serial))
        return unsupported;
    if (to == cast::to_all && is_refused_as_broadcast(pdu))
        return refusal{exception_code::illegal_function, modbus_error::illegal_broadcast, broadcast_detail(pdu)};
    const auto question = modbus::parse_request(pdu);
    if (question)
        return *question;
    if (question.error() == exception_code::illegal_function)
        return unsupported;
    return refusal{question.error(), error_of_value(pdu)};
}

}  // namespace plcgw
