#include "bridge/plc/models/fp7.hpp"

#include "bridge/plc/models/functions.hpp"

namespace plcgw::plc {
namespace {

using enum device_kind;
using enum modbus::table;

// clang-format off
constexpr device_name names[] = {
    {x,           "X", numbering::word_and_bit},
    {y,           "Y", numbering::word_and_bit},
    {relay,       "R", numbering::word_and_bit},
    {link_relay,  "L", numbering::word_and_bit},
    {wx,          "WX"},
    {wy,          "WY"},
    {wr,          "WR"},
    {wl,          "WL"},
    {d,           "DT"},
    {ld,          "LD"},
    {ts,          "T"},
    {cs,          "C"},
    {timer_set,   "TS"},
    {tn,          "TE"},
    {counter_set, "CS"},
    {cn,          "CE"},
    {um,          "UM"},
    {timer_set,   "TSV"},   // as FPWIN Pro writes them
    {tn,          "TEV"},
    {counter_set, "CSV"},
    {cn,          "CEV"},
};

// Ranges of 8.2 where it has the device; words 0 to 511 of Y from 4.2. Timers and counters are no matter of this manual:
// the FP7 CPU unit has 4096 and 1024, with 32-bit values.
constexpr area areas[] = {
    // kind      first  count  bits
    {x,           0,     8192,   1, 0, wx},   // X0-X511F
    {y,           0,     8192,   1, 0, wy},   // Y0-Y511F
    {relay,       0,    32768,   1, 0, wr},   // R0-R2047F
    {link_relay,  0,    16384,   1, 0, wl},   // L0-L1023F
    {ts,          0,     4096,   1},
    {cs,          0,     1024,   1},
    {d,           0,    65536,  16},
    {ld,          0,    16384,  16},
    {timer_set,   0,     4096,  32},
    {tn,          0,     4096,  32},
    {counter_set, 0,     1024,  32},
    {cn,          0,     1024,  32},
    {um,          0,      300,  16},          // COM.0, COM.1, COM.2
};

constexpr map_row standard_map[] = {
    // table            first    count   head
    {discrete_inputs,   0x0000,   8192, {x, 0}},

    {coils,             0x0000,   2048, {y, 0}},      // to Y127F
    {coils,             0x0800,  32768, {relay, 0}},

    {input_registers,   0x0000,   1024, {wl, 0}},
    {input_registers,   0x07D0,  16384, {ld, 0}},

    {holding_registers, 0x0000,  65536, {d, 0}},
};

// 4.1.1 but for what the program may set: Y10-Y12 reset a port, Y14 is RTS.
constexpr device_run status[] = {
    {{x, 0}, 32},
    {{y, 0}, 16},
    {{um, 0}, 300},
};

// The ports of the CPU unit. They have no special devices; which port it is tells the contacts of 4.1.1.
constexpr channel channels[] = {{.number = 0}, {.number = 1}, {.number = 2}};
// clang-format on

}  // namespace

// Over TCP, too, what the table marks: its functions 08, 22 and 23 are not for this PLC to answer.
constinit const model fp7{.name = "FP7",
                          .areas = areas,
                          .standard_map = standard_map,
                          .functions = basic_functions,
                          .user_defined_map = false,
                          .serial_functions = basic_functions,
                          .channels = channels,
                          .one_channel = false,
                          .ascii = false,
                          .errors = error_style::fx3,
                          .format = format_style::fx3,
                          .timers = timer_names::contact_and_value,
                          .names = names,
                          .examples = "DT100, R1F or WR3",
                          .programs = false,
                          .mewtocol = true,
                          .status = status};

}  // namespace plcgw::plc
