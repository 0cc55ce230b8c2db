#include "bridge/plc/adprw_command.hpp"

#include "protocols/modbus/wire.hpp"

namespace plcgw::plc {
namespace {

using modbus::function;

// Everything but the unit, one function for each shape of section 8.3. Operands are read in their order, so that the
// first wrong one is the fault.
adprw_command read(operand_reader& in, const command_row& row, modbus::table from)
{
    const modbus::address first{in.value(3)};
    const std::uint16_t count = in.value(4, row.s3_least, row.s3_most);
    return {{}, modbus::read_table{from, first, count}, in.block(row.s4, is_bit_table(from) ? count : 16U * count)};
}

adprw_command write_coil(operand_reader& in, const command_row& row)
{
    const modbus::address at{in.value(3)};
    in.value(4, row.s3_least, row.s3_most);
    return {{}, modbus::write_single_coil{at, in.coil(row.s4)}, {}};
}

adprw_command write_register(operand_reader& in, const command_row& row)
{
    const modbus::address at{in.value(3)};
    in.value(4, row.s3_least, row.s3_most);
    return {{}, modbus::write_single_register{at, in.words(row.s4, 1).front()}, {}};
}

adprw_command write_coils(operand_reader& in, const command_row& row)
{
    const modbus::address first{in.value(3)};
    const std::uint16_t count = in.value(4, row.s3_least, row.s3_most);
    return {{}, modbus::write_multiple_coils{first, in.coils(row.s4, count)}, {}};
}

adprw_command write_registers(operand_reader& in, const command_row& row)
{
    const modbus::address first{in.value(3)};
    const std::uint16_t count = in.value(4, row.s3_least, row.s3_most);
    return {{}, modbus::write_multiple_registers{first, in.words(row.s4, count)}, {}};
}

adprw_command mask_write(operand_reader& in, const command_row& row)
{
    const modbus::address at{in.value(3)};
    const std::uint16_t and_mask = in.value(4);
    return {{}, modbus::mask_write_register{at, and_mask, in.words(row.s4, 1).front()}, {}};
}

// S2 and S3 are two registers each: of the write, then of the read. S4/D holds what is written, then what is read.
adprw_command read_write(operand_reader& in, const command_row& row)
{
    const auto [write_first, read_first] = in.pair(3);
    const auto [write_count, read_count] = in.pair(4);
    if (write_count < row.s3_least || write_count > row.s3_most || read_count < 1 ||
        read_count > modbus::max_read_registers)
        in.refuse(4, operation_error::out_of_range);
    if (in.fault())
        return {};
    auto target = in.block(row.s4, 16U * (write_count + read_count));
    auto values = in.words(row.s4, write_count);
    if (target)
        target->bit += 16U * write_count;
    return {{},
            modbus::read_write_multiple_registers{modbus::address{read_first}, read_count, modbus::address{write_first},
                                                  std::move(values)},
            target};
}

// A function code alone.
adprw_command report(operand_reader& in, const command_row& row, modbus::request what, unsigned answer_words)
{
    in.value(3, 0, 0);
    in.value(4, row.s3_least, row.s3_most);
    return {{}, std::move(what), in.block(row.s4, 16U * answer_words)};
}

adprw_command diagnose(operand_reader& in, const command_row& row)
{
    const diagnostic_row* const sub = find_diagnostic(in.value(3));
    if (sub == nullptr) {
        in.refuse(3, operation_error::out_of_range);
        return {};
    }
    const std::uint16_t data = in.value(4, 0, sub->s3_most);
    if (sub->code == modbus::diagnostic::restart_communications && data != 0 && data != sub->s3_most)
        in.refuse(4, operation_error::out_of_range);

    modbus::diagnostics asked{sub->code, {}};
    const bool delimiter = sub->code == modbus::diagnostic::change_ascii_delimiter;  // the high byte on the wire
    modbus::append_word(asked.data, static_cast<std::uint16_t>(delimiter ? data << 8 : data));
    if (sub->code != modbus::diagnostic::force_listen_only)
        return {{}, std::move(asked), in.block(row.s4, 16)};

    // Nothing comes back: S4/D is "0 (fixed)" and "D, R", a constant 0 or a register that is left alone.
    if (in.is_constant(5))
        in.value(5, 0, 0);
    else
        in.block(row.s4, 16);
    return {{}, std::move(asked), {}};
}

adprw_command ask(operand_reader& in, const command_row& row)
{
    switch (row.code) {
    case function::read_coils: return read(in, row, modbus::table::coils);
    case function::read_discrete_inputs: return read(in, row, modbus::table::discrete_inputs);
    case function::read_holding_registers: return read(in, row, modbus::table::holding_registers);
    case function::read_input_registers: return read(in, row, modbus::table::input_registers);
    case function::write_single_coil: return write_coil(in, row);
    case function::write_single_register: return write_register(in, row);
    case function::read_exception_status: return report(in, row, modbus::read_exception_status{}, 1);
    case function::diagnostics: return diagnose(in, row);
    case function::get_comm_event_counter: return report(in, row, modbus::get_comm_event_counter{}, 2);
    case function::get_comm_event_log: return report(in, row, modbus::get_comm_event_log{}, 4 + event_log_words);
    case function::write_multiple_coils: return write_coils(in, row);
    case function::write_multiple_registers: return write_registers(in, row);
    case function::report_server_id: return report(in, row, modbus::report_server_id{}, 2);
    case function::mask_write_register: return mask_write(in, row);
    case function::read_write_multiple_registers: return read_write(in, row);
    case function::encapsulated_interface: break;  // no row has it
    }
    return {};
}

}  // namespace

boost::system::result<adprw_command, operand_fault> evaluate(const adprw& of, const memory& devices)
{
    operand_reader in(of, devices);
    const std::uint16_t unit = in.value(1, 0, highest_unit);
    const command_row* const row = find_command(devices.model(), in.value(2));
    if (row == nullptr)
        in.refuse(2, operation_error::out_of_range);
    if (in.fault())
        return *in.fault();
    adprw_command asked = ask(in, *row);
    if (in.fault())
        return *in.fault();
    asked.unit = modbus::unit_id{static_cast<std::uint8_t>(unit)};
    return asked;
}

}  // namespace plcgw::plc
