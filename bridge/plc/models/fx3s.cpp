#include "bridge/plc/models/fx3s.hpp"

#include "bridge/plc/models/functions.hpp"

namespace plcgw::plc {
namespace {

using enum device_kind;
using enum modbus::table;

// clang-format off
constexpr area areas[] = {
    // kind  first  count  bits
    {x,       0,      16,   1},   // X0-X17
    {y,       0,      14,   1},   // Y0-Y15
    {m,       0,    1536,   1},
    {m,    8000,     512,   1},   // special
    {s,       0,     256,   1},
    {ts,      0,     138,   1},
    {cs,      0,      32,   1},
    {cs,    192,      64,   1, 8},  // CS200-CS255, which begin inside a register
    {d,       0,    3000,  16},
    {d,    8000,     512,  16},   // special
    {tn,      0,     138,  16},
    {cn,      0,      32,  16},
    {cn,    200,      56,  32},
};

// Every device stands where the FX3U has it; what the FX3S lacks is an unused address. CS200-CS255 are printed at A7A4H:
// that is the place of CS192 in the other models, so CS200 is bit 8 of it.
constexpr map_row standard_map[] = {
    // table            first    count   head
    {discrete_inputs,   0x0000,   1536, {m, 0}},
    {discrete_inputs,   0x1E00,    512, {m, 8000}},
    {discrete_inputs,   0x2000,    256, {s, 0}},
    {discrete_inputs,   0x3000,    138, {ts, 0}},
    {discrete_inputs,   0x3200,     32, {cs, 0}},
    {discrete_inputs,   0x32C8,     56, {cs, 200}},
    {discrete_inputs,   0x3300,     14, {y, 0}},
    {discrete_inputs,   0x3400,     16, {x, 0}},

    {coils,             0x0000,   1536, {m, 0}},
    {coils,             0x1E00,    512, {m, 8000}},
    {coils,             0x2000,    256, {s, 0}},
    {coils,             0x3000,    138, {ts, 0}},
    {coils,             0x3200,     32, {cs, 0}},
    {coils,             0x32C8,     56, {cs, 200}},
    {coils,             0x3300,     14, {y, 0}},

    {input_registers,   0x0000,   3000, {d, 0}},
    {input_registers,   0x1F40,    512, {d, 8000}},
    {input_registers,   0xA140,    138, {tn, 0}},
    {input_registers,   0xA340,     32, {cn, 0}},
    {input_registers,   0xA408,    112, {cn, 200}},
    {input_registers,   0xA478,     96, {m, 0}},
    {input_registers,   0xA658,     32, {m, 8000}},
    {input_registers,   0xA678,     16, {s, 0}},
    {input_registers,   0xA778,      9, {ts, 0}},
    {input_registers,   0xA798,      2, {cs, 0}},
    {input_registers,   0xA7A4,      4, {cs, 192}},
    {input_registers,   0xA7A8,      1, {y, 0}},
    {input_registers,   0xA7B8,      1, {x, 0}},

    {holding_registers, 0x0000,   3000, {d, 0}},
    {holding_registers, 0x1F40,    512, {d, 8000}},
    {holding_registers, 0xA140,    138, {tn, 0}},
    {holding_registers, 0xA340,     32, {cn, 0}},
    {holding_registers, 0xA408,    112, {cn, 200}},
    {holding_registers, 0xA478,     96, {m, 0}},
    {holding_registers, 0xA658,     32, {m, 8000}},
    {holding_registers, 0xA678,     16, {s, 0}},
    {holding_registers, 0xA778,      9, {ts, 0}},
    {holding_registers, 0xA798,      2, {cs, 0}},
    {holding_registers, 0xA7A4,      4, {cs, 192}},
    {holding_registers, 0xA7A8,      1, {y, 0}},
};
// clang-format on

}  // namespace

constinit const model fx3s{.name = "FX3S",
                           .areas = areas,
                           .standard_map = standard_map,
                           .functions = basic_functions_over_tcp,
                           .user_defined_map = false,
                           .serial_functions = basic_functions,
                           .channels = std::span(fx3g_channels).first(1),
                           .one_channel = true,
                           .ascii = false,
                           .errors = error_style::fx3,
                           .format = format_style::fx3,
                           .timers = timer_names::contact_and_value};

}  // namespace plcgw::plc
