// Every request, response and exception that is spoken here, as bytes written by hand and as the structs that they
// mean. Whatever reads, writes, cuts or damages frames takes them from here.
#pragma once

#include "protocols/modbus/response.hpp"

#include <string_view>

namespace plcgw::test {

// A request and its response, both as PDUs.
struct exchange {
    const char* name;  // with the section of V1.1b3, or of the FX3 manual if it is 7 something
    buffer asks;
    modbus::request question;
    buffer answers;  // empty where the server stays silent
    modbus::response answer;
};

const std::vector<exchange>& exchanges();

// V1.1b3 chapter 7; the PDU is the function with its highest bit set, and this byte.
struct exception_row {
    std::uint8_t byte;
    modbus::exception_code code;
};

inline constexpr exception_row exceptions[] = {
    {0x01, modbus::exception_code::illegal_function},
    {0x02, modbus::exception_code::illegal_data_address},
    {0x03, modbus::exception_code::illegal_data_value},
    {0x04, modbus::exception_code::server_device_failure},
    {0x05, modbus::exception_code::acknowledge},
    {0x06, modbus::exception_code::server_device_busy},
    {0x08, modbus::exception_code::memory_parity_error},
    {0x0A, modbus::exception_code::gateway_path_unavailable},
    {0x0B, modbus::exception_code::gateway_target_failed_to_respond},
};

// What a client may hear: each response, and each exception to each question.
struct reply {
    std::string name;
    modbus::request question;
    buffer pdu;
    modbus::response meaning;
};

std::vector<reply> replies();

// Whole frames with their checks, none of them computed by our own code.
struct whole_frame {
    const char* name;
    modbus::frame content;
    buffer rtu;
    std::string_view ascii;
    buffer tcp;  // transaction 1501H
};

const std::vector<whole_frame>& whole_frames();

std::vector<bool> bits(std::string_view lowest_first);  // blanks are left out

// RTU with a CRC that is computed bit by bit, as FX3 manual 7.2.1 tells it; ours comes from a table.
buffer rtu_frame(modbus::unit_id unit, const buffer& pdu);

// ASCII, digit by digit.
buffer ascii_frame(modbus::unit_id unit, const buffer& pdu);

// MODBUS TCP, with a header written byte by byte.
buffer tcp_frame_of(std::uint16_t transaction, modbus::unit_id unit, const buffer& pdu);

}  // namespace plcgw::test
