// Requests as structs: what a PDU asks for, once its lengths and counts are checked (V1.1b3 chapter 6).
#pragma once

#include "protocols/modbus/types.hpp"

#include <boost/system/result.hpp>

#include <optional>
#include <variant>
#include <vector>

namespace plcgw::modbus {

// A read of one of the four tables: functions 01 to 04.
struct read_table {
    table from{};
    address first{};
    std::uint16_t count{};
    bool operator==(const read_table&) const = default;
};

struct write_single_coil {
    address at{};
    bool on{};
    bool operator==(const write_single_coil&) const = default;
};

struct write_single_register {
    address at{};
    std::uint16_t value{};
    bool operator==(const write_single_register&) const = default;
};

struct write_multiple_coils {
    address first{};
    std::vector<bool> values;
    bool operator==(const write_multiple_coils&) const = default;
};

struct write_multiple_registers {
    address first{};
    std::vector<std::uint16_t> values;
    bool operator==(const write_multiple_registers&) const = default;
};

struct mask_write_register {
    address at{};
    std::uint16_t and_mask{};
    std::uint16_t or_mask{};
    bool operator==(const mask_write_register&) const = default;
};

struct read_write_multiple_registers {
    address read_first{};
    std::uint16_t read_count{};
    address write_first{};
    std::vector<std::uint16_t> values;  // written before the read
    bool operator==(const read_write_multiple_registers&) const = default;
};

struct read_exception_status {
    bool operator==(const read_exception_status&) const = default;
};

// Function 08. Every sub-function but "return query data" carries one word.
struct diagnostics {
    diagnostic what{};
    buffer data;  // as on the wire: an even number of bytes, 2 or more
    bool operator==(const diagnostics&) const = default;
};

struct get_comm_event_counter {
    bool operator==(const get_comm_event_counter&) const = default;
};

struct get_comm_event_log {
    bool operator==(const get_comm_event_log&) const = default;
};

struct report_server_id {
    bool operator==(const report_server_id&) const = default;
};

// Function 2B with MEI type 0E (V1.1b3 section 6.21).
struct read_device_identification {
    enum class access : std::uint8_t { basic = 1, regular = 2, extended = 3, one_object = 4 } how{};
    std::uint8_t first_object{};
    bool operator==(const read_device_identification&) const = default;
};

using request =
    std::variant<read_table, write_single_coil, write_single_register, write_multiple_coils, write_multiple_registers,
                 mask_write_register, read_write_multiple_registers, read_exception_status, diagnostics,
                 get_comm_event_counter, get_comm_event_log, report_server_id, read_device_identification>;

function function_of(const request& r);

// Checks function code (01), then quantity, value and byte count (03). Addresses are the memory's business (02).
boost::system::result<request, exception_code> parse_request(bytes pdu);

buffer encode_request(const request& r);  // the PDU

}  // namespace plcgw::modbus
