#include "bridge/plc/models/fx3u.hpp"

#include "bridge/plc/models/functions.hpp"

namespace plcgw::plc {
namespace {

using enum device_kind;
using enum modbus::table;

// clang-format off
constexpr area areas[] = {
    // kind  first  count  bits
    {x,       0,     256,   1},   // X0-X377
    {y,       0,     256,   1},   // Y0-Y377
    {m,       0,    7680,   1},
    {m,    8000,     512,   1},   // special
    {s,       0,    4096,   1},
    {ts,      0,     512,   1},
    {cs,      0,     256,   1},
    {d,       0,    8000,  16},
    {d,    8000,     512,  16},   // special
    {r,       0,   32768,  16},
    {tn,      0,     512,  16},
    {cn,      0,     200,  16},
    {cn,    200,      56,  32},
};

constexpr map_row standard_map[] = {
    // table            first    count   head
    {discrete_inputs,   0x0000,   7680, {m, 0}},
    {discrete_inputs,   0x1E00,    512, {m, 8000}},
    {discrete_inputs,   0x2000,   4096, {s, 0}},
    {discrete_inputs,   0x3000,    512, {ts, 0}},
    {discrete_inputs,   0x3200,    256, {cs, 0}},
    {discrete_inputs,   0x3300,    256, {y, 0}},
    {discrete_inputs,   0x3400,    256, {x, 0}},

    {coils,             0x0000,   7680, {m, 0}},
    {coils,             0x1E00,    512, {m, 8000}},
    {coils,             0x2000,   4096, {s, 0}},
    {coils,             0x3000,    512, {ts, 0}},
    {coils,             0x3200,    256, {cs, 0}},
    {coils,             0x3300,    256, {y, 0}},

    {input_registers,   0x0000,   8000, {d, 0}},
    {input_registers,   0x1F40,    512, {d, 8000}},
    {input_registers,   0x2140,  32768, {r, 0}},
    {input_registers,   0xA140,    512, {tn, 0}},
    {input_registers,   0xA340,    200, {cn, 0}},
    {input_registers,   0xA408,    112, {cn, 200}},
    {input_registers,   0xA478,    480, {m, 0}},
    {input_registers,   0xA658,     32, {m, 8000}},
    {input_registers,   0xA678,    256, {s, 0}},
    {input_registers,   0xA778,     32, {ts, 0}},
    {input_registers,   0xA798,     16, {cs, 0}},
    {input_registers,   0xA7A8,     16, {y, 0}},
    {input_registers,   0xA7B8,     16, {x, 0}},

    {holding_registers, 0x0000,   8000, {d, 0}},
    {holding_registers, 0x1F40,    512, {d, 8000}},
    {holding_registers, 0x2140,  32768, {r, 0}},
    {holding_registers, 0xA140,    512, {tn, 0}},
    {holding_registers, 0xA340,    200, {cn, 0}},
    {holding_registers, 0xA408,    112, {cn, 200}},
    {holding_registers, 0xA478,    480, {m, 0}},
    {holding_registers, 0xA658,     32, {m, 8000}},
    {holding_registers, 0xA678,    256, {s, 0}},
    {holding_registers, 0xA778,     32, {ts, 0}},
    {holding_registers, 0xA798,     16, {cs, 0}},
    {holding_registers, 0xA7A8,     16, {y, 0}},
};
// clang-format on

constexpr model made(std::string_view name)
{
    return {.name = name,
            .areas = areas,
            .standard_map = standard_map,
            .functions = fx3u_functions_over_tcp,
            .user_defined_map = true,
            .serial_functions = fx3u_functions,
            .channels = fx3u_channels,
            .one_channel = true,
            .ascii = true,
            .errors = error_style::fx3,
            .format = format_style::fx3,
            .timers = timer_names::contact_and_value};
}

}  // namespace

constinit const model fx3u = made("FX3U");
constinit const model fx3uc = made("FX3UC");

}  // namespace plcgw::plc
