// The words of the MODBUS Application Protocol Specification V1.1b3 (sections 4 to 7) as types.
#pragma once

#include "protocols/bytes.hpp"

#include <string_view>

namespace plcgw::modbus {

enum class unit_id : std::uint8_t { broadcast = 0 };
enum class address : std::uint16_t {};  // zero-based protocol address, not a 4xxxx reference

constexpr std::uint16_t number(address a) { return static_cast<std::uint16_t>(a); }
constexpr unsigned number(unit_id u) { return static_cast<unsigned>(u); }

enum class function : std::uint8_t {
    read_coils = 0x01,
    read_discrete_inputs = 0x02,
    read_holding_registers = 0x03,
    read_input_registers = 0x04,
    write_single_coil = 0x05,
    write_single_register = 0x06,
    read_exception_status = 0x07,
    diagnostics = 0x08,
    get_comm_event_counter = 0x0B,
    get_comm_event_log = 0x0C,
    write_multiple_coils = 0x0F,
    write_multiple_registers = 0x10,
    report_server_id = 0x11,
    mask_write_register = 0x16,
    read_write_multiple_registers = 0x17,
    encapsulated_interface = 0x2B,
};

// Sub-functions of diagnostics (V1.1b3 section 6.8, FX3 manual 7.11).
enum class diagnostic : std::uint16_t {
    return_query_data = 0x00,
    restart_communications = 0x01,
    return_diagnostic_register = 0x02,
    change_ascii_delimiter = 0x03,
    force_listen_only = 0x04,
    clear_counters = 0x0A,
    bus_message_count = 0x0B,
    bus_communication_error_count = 0x0C,
    bus_exception_error_count = 0x0D,
    server_message_count = 0x0E,
    server_no_response_count = 0x0F,
    server_nak_count = 0x10,
    server_busy_count = 0x11,
    bus_character_overrun_count = 0x12,
};

enum class exception_code : std::uint8_t {
    illegal_function = 0x01,
    illegal_data_address = 0x02,
    illegal_data_value = 0x03,
    server_device_failure = 0x04,
    acknowledge = 0x05,
    server_device_busy = 0x06,
    memory_parity_error = 0x08,
    gateway_path_unavailable = 0x0A,
    gateway_target_failed_to_respond = 0x0B,
};

std::string_view to_string(exception_code e);

// The four tables of the data model (V1.1b3 section 4.3).
enum class table : std::uint8_t { coils, discrete_inputs, input_registers, holding_registers };

std::string_view to_string(table t);  // "coil", "discrete", "input", "holding": as in the configuration

constexpr bool is_bit_table(table t) { return t == table::coils || t == table::discrete_inputs; }

// Items at most in one request (V1.1b3 sections 6.1 to 6.17).
inline constexpr std::uint16_t max_read_bits = 2000;
inline constexpr std::uint16_t max_read_registers = 125;
inline constexpr std::uint16_t max_write_coils = 1968;
inline constexpr std::uint16_t max_write_registers = 123;
inline constexpr std::uint16_t max_read_write_registers = 121;  // the written part of function 17H

inline constexpr std::size_t max_pdu_size = 253;

// An ADU with its envelope (unit and CRC, LRC or MBAP) already checked and removed.
struct frame {
    unit_id unit{};
    buffer pdu;
    bool operator==(const frame&) const = default;  // tests compare frames
};

}  // namespace plcgw::modbus
