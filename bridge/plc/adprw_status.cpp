#include "bridge/plc/adprw_status.hpp"

namespace plcgw::plc {
namespace {

constexpr std::uint32_t operation_error_device = 8067;  // M8067, D8067
constexpr unsigned protocol_server = 1U << 4;
constexpr unsigned ls_modbus = 1U << 14;
constexpr unsigned ls_client = 1U << 15;

// What each failure counts as. A frame that is not this question's answer is a message all the same.
struct count_row {
    errc why;
    counter which;
};

constexpr count_row counts[] = {
    {errc::unexpected_answer, counter::bus_message},      {errc::bad_checksum, counter::bus_communication_error},
    {errc::bad_header, counter::bus_communication_error}, {errc::incomplete, counter::bus_communication_error},
    {errc::too_short, counter::bus_communication_error},  {errc::bad_character, counter::bus_communication_error},
    {errc::collision, counter::bus_communication_error},  {errc::overlong, counter::character_overrun},
    {errc::line_not_quiet, counter::character_overrun},
};

}  // namespace

modbus_error ls_error(const adprw_error& e)
{
    const auto composed = [](unsigned head, unsigned high, unsigned low) {
        return static_cast<modbus_error>(head * 10000 + high % 100 * 100 + low % 100);
    };
    switch (e.code) {
    case modbus_error::exception_response: return composed(2, e.high & 0x7FU, e.low);
    case modbus_error::station_mismatch: return composed(3, e.high, e.low);
    case modbus_error::function_mismatch: return composed(4, e.high & 0x7FU, e.low & 0x7FU);
    case modbus_error::bad_operand: return static_cast<modbus_error>(2180 + e.low);
    case modbus_error::invalid_hardware: return modbus_error::timeout;
    case modbus_error::unconvertible_character: return modbus_error::length_mismatch;
    default: return e.code;
    }
}

adprw_status::adprw_status(simulated_plc& plc, const channel& of)
    : plc_(&plc), channel_(&of), ls_(plc.model().errors == error_style::ls)
{
}

void adprw_status::started(std::uint16_t step)
{
    const channel_flags& m = channel_->flags;
    clear_command();
    plc_->show_flag(m.completed, false);
    plc_->show_flag(m.error, false);
    if (ls_)
        plc_->show_flag(m.error_latched, false);  // LS manual 4-3: latched until the next command only
    plc_->show_flag(m.busy, true);
    plc_->show_register(channel_->registers.executing_step, step);
}

void adprw_status::clear_command()
{
    plc_->show_flag(channel_->flags.retrying, false);
    plc_->show_flag(channel_->flags.timeout, false);
    plc_->show_register(channel_->registers.retry_value, 0);
}

void adprw_status::retrying(unsigned retry)
{
    plc_->show_flag(channel_->flags.retrying, true);
    plc_->show_register(channel_->registers.retry_value, static_cast<std::uint16_t>(retry));
}

void adprw_status::completed()
{
    plc_->show_flag(channel_->flags.busy, false);
    plc_->show_flag(channel_->flags.completed, true);
}

void adprw_status::failed(const adprw_error& e, std::uint16_t step)
{
    show(e, step);
    plc_->show_flag(channel_->flags.timeout, (ls_ ? ls_error(e) : e.code) == modbus_error::timeout);
    completed();
}

// Neither clears first what it sets then: an instruction that is refused in every scan changes its devices once.
void adprw_status::refused_in_server(std::uint16_t step)
{
    clear_command();
    plc_->show_flag(channel_->flags.completed, false);
    show({modbus_error::instruction_in_server}, step);
}

void adprw_status::refused(const operand_fault& fault, std::uint16_t step)
{
    clear_command();
    plc_->show_flag(channel_->flags.completed, false);
    show({modbus_error::bad_operand, 0, static_cast<std::uint8_t>(fault.operand)}, step);
    if (ls_)
        return;
    plc_->show_flag(operation_error_device, true);
    plc_->show_register(operation_error_device, static_cast<std::uint16_t>(fault.why));
}

void adprw_status::show(const adprw_error& e, std::uint16_t step)
{
    plc_->show_error(channel_->number, ls_ ? ls_error(e) : e.code, static_cast<std::uint16_t>(e.high << 8 | e.low));
    // An FX3 keeps the step of the first error, until a program writes 0. No ADPRW stands at step 0.
    if (ls_ || setting(channel_->registers.error_step) == 0)
        plc_->show_register(channel_->registers.error_step, step);
}

void adprw_status::count_answer(const modbus::response& answer)
{
    if (std::holds_alternative<modbus::no_response>(answer))
        return;
    count(counter::bus_message);
    if (std::holds_alternative<modbus::exception_code>(answer))
        count(counter::exception_error);
}

void adprw_status::count_fault(const modbus::answer_fault& fault)
{
    for (const count_row& row : counts)
        if (row.why == fault.why)
            count(row.which);
}

void adprw_status::count(counter which)
{
    counters_.count(which);
    const std::optional<place>& first = plc_->channel_at(channel_->number).status.counters;
    for (std::size_t i = 0; first && i < counter_registers; ++i)
        plc_->memory().set_word({first->area, first->bit + 16 * i}, counters_.registers()[i]);
}

void adprw_status::program_started()
{
    counters_.clear();
    if (ls_)
        return;
    plc_->show_flag(operation_error_device, false);
    plc_->show_register(operation_error_device, 0);
}

void adprw_status::program_stopped() { plc_->show_flag(channel_->flags.busy, false); }

bool adprw_status::is_server() const
{
    if (plc_->model().format == format_style::ls) {
        const unsigned format = setting(channel_->registers.format);
        return (format & ls_modbus) != 0 && (format & ls_client) == 0;
    }
    return (setting(channel_->registers.protocol) & protocol_server) != 0;
}

std::uint16_t adprw_status::setting(std::uint32_t number) const
{
    const auto at = plc_->memory().find({device_kind::d, number});
    return at && number != 0 ? plc_->memory().word(*at) : std::uint16_t{0};
}

}  // namespace plcgw::plc
