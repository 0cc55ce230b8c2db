#include "bridge/plc/setup_check.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using registers = std::map<std::uint32_t, std::uint16_t>;

constexpr std::uint16_t counters_wanted = 0x0001;  // bits of D8415
constexpr std::uint16_t log_wanted = 0x0010;
constexpr std::uint16_t in_r_devices = 0x0100;

std::uint16_t value_of(const registers& of, std::uint32_t number)
{
    const auto found = of.find(number);
    return found == of.end() ? std::uint16_t{0} : found->second;
}

bool belongs_to(const channel& c, std::uint32_t number)
{
    const channel_registers& r = c.registers;
    const std::uint32_t settings[] = {r.format,        r.protocol, r.delimiter, r.response_timeout, r.turnaround_delay,
                                      r.message_delay, r.retries,  r.station,   r.status_setup,     r.status_head};
    return std::find(std::begin(settings), std::end(settings), number) != std::end(settings);
}

class checker {
public:
    checker(const memory& of, const setup_program& program)
        : memory_(of), program_(program), out_{program.registers, modbus_map::standard(of.model()), {}, {}}
    {
    }

    checked_setup result()
    {
        if (program_.fault)
            refuse(modbus_error::invalid_parameter, channel_with(program_.fault->detail), *program_.fault);
        for (const channel& each : model().channels)
            out_.channels.push_back(set_up(each));
        if (model().one_channel)
            find_double_use();
        if (model().user_defined_map)
            allocate();
        return std::move(out_);
    }

private:
    const plc::model& model() const { return memory_.model(); }

    channel_state set_up(const channel& of)
    {
        channel_state state{.row = &of, .as = {}, .operates = !program_.is_void, .status = {}};
        const channel_registers& r = of.registers;
        const auto settings = decode(model(), of, value(r.format), value(r.protocol));
        if (!settings) {
            state.operates = false;
            refuse_register(of, settings.error().at == settings_fault::in::format ? r.format : r.protocol,
                            settings.error().reason);
        }
        else if (settings->enabled) {
            state.as = settings->as;
        }
        const std::uint16_t station = value(r.station);
        const bool set = out_.registers.contains(r.station);
        if ((set || state.as == role::server) && (station < 1 || station > 247)) {
            state.operates = false;
            refuse_register(of, r.station, "is " + std::to_string(station) + ", which is not within 1 to 247");
        }
        if (program_.fault && program_.fault->detail == r.station)
            state.operates = false;  // its value is not among the registers any more
        if (r.status_setup != 0)
            state.status = find_status_area(of, state.as);
        return state;
    }

    // The ranges of D8416: what is stored must lie within the ordinary D or the R devices.
    status_area find_status_area(const channel& of, std::optional<role> as)
    {
        const std::uint16_t wanted = value(of.registers.status_setup);
        const std::size_t counters = (wanted & counters_wanted) != 0 ? counter_registers : 0;
        const std::size_t size = counters + ((wanted & log_wanted) != 0 ? log_registers : 0);
        if (size == 0)
            return {};
        const device_kind kind = (wanted & in_r_devices) != 0 ? device_kind::r : device_kind::d;
        const std::uint32_t head = value(of.registers.status_head);
        const auto first = memory_.find({kind, head});
        const bool special = kind == device_kind::d && head >= special_first;
        if (!first || special || memory_.bits_from(*first) < 16 * size) {
            const std::string last = to_string(device{kind, head + static_cast<std::uint32_t>(size) - 1});
            refuse_register(of, of.registers.status_head,
                            "asks for " + to_string(device{kind, head}) + "-" + last +
                                ", which this PLC does not have");
            return {};
        }
        status_area found;
        if (counters != 0)
            found.counters = *first;
        if ((wanted & log_wanted) != 0 && as != role::client)
            found.log = place{first->area, first->bit + 16 * counters};
        return found;
    }

    // D8401, note: when both channels are set to MODBUS, priority is given to channel 1.
    void find_double_use()
    {
        bool taken = false;
        for (channel_state& each : out_.channels) {
            const std::uint32_t number = each.row->registers.protocol;
            const bool wants = (value_of(program_.registers, number) & 1U) != 0;
            if (wants && taken) {
                each.operates = false;
                refuse(modbus_error::channel_double_use, each.row->number,
                       {0, line_of(number), "D" + std::to_string(number) + " sets a second channel to MODBUS"});
            }
            taken = taken || wants;
        }
    }

    void allocate()
    {
        allocation sets{};
        for (std::uint32_t i = 0; i < sets.size(); ++i)
            sets[i] = value(allocation_first + i);
        std::optional<allocation_fault> invalid;
        out_.map = modbus_map::user_defined(model(), sets, invalid);
        for (auto& [number, stored] : out_.registers)
            if (number >= allocation_first)
                stored = sets[number - allocation_first];
        if (invalid)
            refuse(modbus_error::invalid_parameter, channel_with(invalid->detail),
                   {invalid->detail, line_of(invalid->detail), std::move(invalid->reason)});
    }

    // A refused value is not entered into its register (12.6, error 0202).
    void refuse_register(const channel& of, std::uint32_t number, const std::string& why)
    {
        const std::size_t line = line_of(number);
        out_.registers.erase(number);
        refuse(modbus_error::invalid_parameter, of.number, {number, line, "D" + std::to_string(number) + " " + why});
    }

    void refuse(modbus_error code, unsigned channel, parameter_fault what)
    {
        const bool known = std::any_of(out_.faults.begin(), out_.faults.end(), [&](const setup_fault& f) {
            return f.code == code && f.channel == channel && f.what.detail == what.detail;
        });
        if (!known)  // a register that the program's reader refused already has no value here
            out_.faults.push_back({code, channel, std::move(what)});
    }

    // Of a fault that lies in no channel's registers, the channel that is set to MODBUS.
    unsigned channel_with(std::uint32_t number) const
    {
        for (const channel& each : model().channels)
            if (belongs_to(each, number) && !program_.is_void)
                return each.number;
        for (const channel_state& each : out_.channels)
            if (each.as)
                return each.row->number;
        return model().channels.front().number;
    }

    std::uint16_t value(std::uint32_t number) const { return value_of(out_.registers, number); }

    std::size_t line_of(std::uint32_t number) const
    {
        const auto found = program_.lines.find(number);
        return found == program_.lines.end() ? 0 : found->second;
    }

    const memory& memory_;
    const setup_program& program_;
    checked_setup out_;
};

}  // namespace

checked_setup check_setup(const memory& of, const setup_program& program) { return checker(of, program).result(); }

}  // namespace plcgw::plc
