#include "bridge/plc/adprw_table.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using modbus::diagnostic;
using modbus::function;
using namespace operands;

constexpr unsigned any = registers | relays | inputs | constants;

// clang-format off
constexpr command_row fx3_commands[] = {
    // S1                                     S3 from, to                          S4/D
    {function::read_coils,                    1, modbus::max_read_bits,            registers | relays},
    {function::read_discrete_inputs,          1, modbus::max_read_bits,            registers | relays},
    {function::read_holding_registers,        1, modbus::max_read_registers,       registers},
    {function::read_input_registers,          1, modbus::max_read_registers,       registers},
    {function::write_single_coil,             0, 0,                                any},
    {function::write_single_register,         0, 0,                                registers | constants},
    {function::read_exception_status,         0, 0,                                registers},
    {function::diagnostics,                   0, 0xFFFF,                           registers},
    {function::get_comm_event_counter,        0, 0,                                registers},
    {function::get_comm_event_log,            0, 0,                                registers},
    {function::write_multiple_coils,          1, modbus::max_write_coils,          any},
    {function::write_multiple_registers,      1, modbus::max_write_registers,      registers | constants},
    {function::report_server_id,              0, 0,                                registers},
    {function::mask_write_register,           0, 0xFFFF,                           registers | constants},
    {function::read_write_multiple_registers, 1, modbus::max_read_write_registers, registers},
};

// Narrower for the writes. 05 and 06 say 1 where FX3 programs have 0: both are taken. 17 is in the list of 6-1 and not
// in the table: it is taken as the FX3 has it.
constexpr command_row ls_commands[] = {
    {function::read_coils,                    1, modbus::max_read_bits,            registers | relays},
    {function::read_discrete_inputs,          1, modbus::max_read_bits,            registers | relays},
    {function::read_holding_registers,        1, modbus::max_read_registers,       registers},
    {function::read_input_registers,          1, modbus::max_read_registers,       registers},
    {function::write_single_coil,             0, 1,                                registers},
    {function::write_single_register,         0, 1,                                registers},
    {function::write_multiple_coils,          1, modbus::max_write_coils,          registers | relays},
    {function::write_multiple_registers,      1, modbus::max_write_registers,      registers},
    {function::read_write_multiple_registers, 1, modbus::max_read_write_registers, registers},
};

constexpr diagnostic_row diagnostics[] = {
    {diagnostic::return_query_data,             0xFFFF},
    {diagnostic::restart_communications,        0xFF00},
    {diagnostic::return_diagnostic_register,    0},
    {diagnostic::change_ascii_delimiter,        0x00FF},
    {diagnostic::force_listen_only,             0},
    {diagnostic::clear_counters,                0},
    {diagnostic::bus_message_count,             0},
    {diagnostic::bus_communication_error_count, 0},
    {diagnostic::bus_exception_error_count,     0},
    {diagnostic::server_message_count,          0},
    {diagnostic::server_no_response_count,      0},
    {diagnostic::server_nak_count,              0},
    {diagnostic::server_busy_count,             0},
    {diagnostic::bus_character_overrun_count,   0},
};
// clang-format on

// Row is command_row or diagnostic_row.
template <class Row>
const Row* find(std::span<const Row> rows, std::uint16_t code)
{
    const auto found = std::find_if(rows.begin(), rows.end(),
                                    [code](const Row& r) { return static_cast<std::uint16_t>(r.code) == code; });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

const command_row* find_command(const model& m, std::uint16_t code)
{
    using rows = std::span<const command_row>;
    const auto* row = find(m.errors == error_style::ls ? rows(ls_commands) : rows(fx3_commands), code);
    return row != nullptr && answers(m, row->code, transport::serial) ? row : nullptr;
}

const diagnostic_row* find_diagnostic(std::uint16_t code)
{
    return find(std::span<const diagnostic_row>(diagnostics), code);
}

}  // namespace plcgw::plc
