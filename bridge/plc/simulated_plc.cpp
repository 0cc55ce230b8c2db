#include "bridge/plc/simulated_plc.hpp"

#include <algorithm>
#include <stdexcept>

namespace plcgw::plc {
namespace {

constexpr std::uint32_t normally_on_in_run = 8000;
constexpr std::uint32_t normally_off_in_run = 8001;
constexpr std::uint16_t line_feed = 0x0A;

void clear(memory& of, std::optional<place> first, std::size_t registers)
{
    for (std::size_t i = 0; first && i < registers; ++i)
        of.show_word({first->area, first->bit + 16 * i}, 0);
}

}  // namespace

simulated_plc::simulated_plc(std::string name, const plc::model& m, setup_program program)
    : name_(std::move(name)), program_(std::move(program)), memory_(m)
{
    protect_read_only();
    power_on();
}

void simulated_plc::power_cycle()
{
    clear_devices();
    power_on();
}

void simulated_plc::power_on()
{
    ++power_ons_;
    ++starts_;
    setup_ = check_setup(memory_, program_);
    for (const auto& [number, value] : setup_.registers)
        show_register(number, value);
    for (const auto& [channel, line] : std::map(attached_))
        attach(channel, line);
    for (const channel_state& each : setup_.channels)
        show_channel(each);
    show_state();

    fault_.reset();
    for (auto each = setup_.faults.rbegin(); each != setup_.faults.rend(); ++each) {  // the first one stays
        show_error(each->channel, each->code, static_cast<std::uint16_t>(each->what.detail));
        if (each->code == modbus_error::invalid_parameter)
            fault_ = each->what;
    }
}

void simulated_plc::run()
{
    if (state_ == run_state::run)
        return;
    state_ = run_state::run;
    ++starts_;
    show_state();
    for (const channel_state& each : setup_.channels) {
        const channel_registers& r = each.row->registers;
        const channel_flags& f = each.row->flags;
        for (const std::uint32_t number : {r.error_step, r.executing_step, r.retry_value})
            show_register(number, 0);
        for (const std::uint32_t number :
             {f.completed, f.busy, f.error, f.error_latched, f.serial_error, f.retrying, f.timeout})
            show_flag(number, false);
        if (each.as == role::client || model().errors == error_style::ls) {
            show_register(r.error_code, 0);
            show_register(r.error_detail, 0);
        }
        clear(memory_, each.status.counters, counter_registers);
        clear(memory_, each.status.log, log_registers);
    }
}

void simulated_plc::stop()
{
    state_ = run_state::stop;
    show_state();
}

const channel_state& simulated_plc::channel_at(unsigned number) const
{
    for (const channel_state& each : setup_.channels)
        if (each.row->number == number)
            return each;
    throw std::out_of_range(name_ + " has no MODBUS channel " + std::to_string(number));
}

void simulated_plc::attach(unsigned channel, const channel_line& line)
{
    const auto index = &channel_at(channel) - setup_.channels.data();
    channel_state& state = setup_.channels[static_cast<std::size_t>(index)];
    attached_[channel] = line;
    state.as = line.as;
    if (line.as == role::client)
        state.status.log.reset();
    show_line(state, line);
    show_channel(state);
}

// What the engineer would otherwise write with MOV (12.5).
void simulated_plc::show_line(const channel_state& c, const channel_line& line)
{
    if (!c.operates)
        return;
    const channel_registers& r = c.row->registers;
    const auto show = [this](std::uint32_t number, std::optional<std::uint16_t> value) {
        if (value && !setup_.registers.contains(number))
            show_register(number, *value);
    };
    channel_settings s{.enabled = true, .mode = line.mode, .as = line.as, .rs485 = line.rs485};
    s.format = line.format.value_or(character_format{});
    if (model().format == format_style::ls) {
        show(r.format, line.format ? encode_ls(s) : std::nullopt);
    }
    else {
        show(r.format, line.format ? encode_fx3_format(s) : std::nullopt);
        show(r.protocol, encode_fx3_protocol(s));
    }
    if (line.as == role::server && line.station != 0)
        show(r.station, line.station);
}

void simulated_plc::show_error(unsigned channel, modbus_error code, std::uint16_t detail)
{
    const plc::channel& row = *channel_at(channel).row;
    if (!exists(code, model().errors))
        return;
    show_register(row.registers.error_code, static_cast<std::uint16_t>(code));
    show_register(row.registers.error_detail, detail);
    show_register(row.registers.serial_error, row.serial_error_value);
    for (const std::uint32_t number : {row.flags.error, row.flags.error_latched, row.flags.serial_error})
        show_flag(number, true);
}

void simulated_plc::show_register(std::uint32_t number, std::uint16_t value)
{
    if (const auto at = memory_.find({device_kind::d, number}); at && number != 0)
        memory_.show_word(*at, value);
}

void simulated_plc::show_flag(std::uint32_t number, bool on)
{
    if (const auto at = memory_.find({device_kind::m, number}); at && number != 0)
        memory_.show_bit(*at, on);
}

bool simulated_plc::flag(std::uint32_t number) const
{
    const auto at = memory_.find({device_kind::m, number});
    return at && number != 0 && memory_.bit(*at);
}

// Word by word, so that everybody who follows the memory's changes sees it.
void simulated_plc::clear_devices()
{
    for (std::size_t i = 0; i < model().areas.size(); ++i)
        clear(memory_, place{i, 0}, (memory_.bits_from({i, 0}) + 15) / 16);
}

void simulated_plc::show_state()
{
    show_flag(normally_on_in_run, state_ == run_state::run);
    show_flag(normally_off_in_run, state_ == run_state::stop);
}

// D8405, D8406 and D8419. The delimiter is the program's to choose in a client only.
void simulated_plc::show_channel(const channel_state& c)
{
    const channel_registers& r = c.row->registers;
    const bool in_use = c.as && c.operates;
    const auto set = [&](std::uint32_t number, std::uint16_t initially) {
        const auto found = setup_.registers.find(number);
        return found == setup_.registers.end() ? initially : found->second;
    };
    const auto line = attached_.find(c.row->number);
    std::optional<std::uint16_t> format;
    if (line != attached_.end() && line->second.format)
        format = encode_fx3_format({.rs485 = line->second.rs485, .format = *line->second.format});
    show_register(r.mode, in_use ? mode_modbus : std::uint16_t{0});
    show_register(r.format_display, in_use ? format.value_or(set(r.format, 0)) : std::uint16_t{0});
    show_register(r.delimiter, c.as == role::client ? set(r.delimiter, line_feed) : line_feed);
    if (const auto at = memory_.find({device_kind::d, r.delimiter}); at && r.delimiter != 0)
        memory_.set_protected(*at, 16, c.as == role::server);
}

// An LS manual marks its registers "R, W", all of them.
void simulated_plc::protect_read_only()
{
    const auto protect = [this](device_kind kind, std::uint32_t number, std::size_t bits) {
        if (const auto at = memory_.find({kind, number}); at && number != 0)
            memory_.set_protected(*at, bits, true);
    };
    for (const channel& each : model().channels) {
        const channel_registers& r = each.registers;
        const channel_flags& f = each.flags;
        for (const std::uint32_t number : {f.completed, f.busy, f.listen_only, f.retrying, f.timeout})
            protect(device_kind::m, number, 1);
        if (model().format == format_style::fx3)
            for (const std::uint32_t number : {r.format_display, r.executing_step, r.retry_value, r.mode})
                protect(device_kind::d, number, 16);
    }
}

}  // namespace plcgw::plc
