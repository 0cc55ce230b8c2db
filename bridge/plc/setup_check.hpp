// What a PLC makes of its setup program at power-on: FX3 manual 5.4, 6.1, 6.2, 9.4 and 12.6.
#pragma once

#include "bridge/plc/channel_settings.hpp"
#include "bridge/plc/modbus_error.hpp"
#include "bridge/plc/modbus_map.hpp"
#include "bridge/plc/setup_program.hpp"

namespace plcgw::plc {

// Where a channel shows its counters and its event log (6.4, 9.5.1); nothing when not asked for or refused.
struct status_area {
    std::optional<place> counters;  // 10 registers
    std::optional<place> log;       // 33 registers: its length, and two events in each of the others
};

inline constexpr std::size_t counter_registers = 10;
inline constexpr std::size_t log_registers = 33;

struct channel_state {
    const channel* row{};    // its special devices
    std::optional<role> as;  // nothing: the channel is not set to MODBUS
    bool operates = true;    // false: refused, or another channel comes first. Such a server answers nothing
    status_area status;
};

struct setup_fault {
    modbus_error code{};
    unsigned channel{};  // whose registers show it
    parameter_fault what;
};

struct checked_setup {
    std::map<std::uint32_t, std::uint16_t> registers;  // D numbers and what comes to stand in them
    modbus_map map;
    std::vector<channel_state> channels;  // in the model's order
    std::vector<setup_fault> faults;      // a channel shows its first one
};

checked_setup check_setup(const memory& of, const setup_program& program);

}  // namespace plcgw::plc
