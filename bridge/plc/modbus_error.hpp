// The MODBUS error codes that a PLC shows in D8402 or D8422: FX3 manual 12.6, LS manual 9-6.
#pragma once

#include "bridge/plc/model.hpp"

#include <algorithm>

namespace plcgw::plc {

enum class modbus_error : std::uint16_t {
    invalid_hardware = 201,   // detail: the channel
    invalid_parameter = 202,  // detail: the D register
    channel_double_use = 203,
    bit_level = 204,          // parity, framing, receive register overrun
    checksum = 205,           // CRC or LRC, or too short
    character_overrun = 206,  // too long, or the request before is still in process
    length_mismatch = 207,
    unconvertible_character = 208,
    unsupported_function = 209,
    invalid_address = 210,
    timeout = 211,
    exception_response = 212,  // detail: function, exception code
    station_mismatch = 213,    // detail: asked, answered
    function_mismatch = 214,   // detail: asked, answered
    illegal_broadcast = 215,   // detail: 0 and function, or 08 and sub-function
    illegal_value = 216,
    instruction_in_server = 217,
    bad_operand = 218,  // detail: its number
};

// The LS manual's list has no others. (Its codes with two digits of detail are beyond 1000, and the client's.)
constexpr bool exists(modbus_error e, error_style in)
{
    constexpr std::uint16_t ls_codes[] = {202, 204, 205, 206, 207, 211, 216};
    const auto code = static_cast<std::uint16_t>(e);
    return in == error_style::fx3 || code >= 1000 ||
           std::find(std::begin(ls_codes), std::end(ls_codes), code) != std::end(ls_codes);
}

}  // namespace plcgw::plc
