#include "bridge/plc/models/ls.hpp"

#include "bridge/plc/models/functions.hpp"

namespace plcgw::plc {
namespace {

using enum device_kind;
using enum modbus::table;

// The map shows D8000-D8255 and M8000-M8255 only, but the settings are D8400-D8437: the special areas are an FX3U's. R
// is an operand of ADPRW without a printed range: an FX3U's too.
// clang-format off
constexpr area areas[] = {
    // kind  first  count  bits
    {x,       0,     184,   1},   // X0-X267
    {y,       0,     184,   1},   // Y0-Y267
    {m,       0,    3072,   1},
    {m,    8000,     512,   1},   // special
    {s,       0,    1000,   1},
    {ts,      0,     256,   1},
    {cs,      0,     256,   1},
    {d,       0,    8000,  16},
    {d,    8000,     512,  16},   // special
    {r,       0,   32768,  16},
    {tn,      0,     256,  16},
    {cn,      0,     200,  16},
    {cn,    200,      56,  32},
};

// The input registers are empty.
constexpr map_row standard_map[] = {
    // table            first    count   head
    {discrete_inputs,   0x3400,    184, {x, 0}},

    {coils,             0x0000,   3072, {m, 0}},
    {coils,             0x1E00,    256, {m, 8000}},
    {coils,             0x2000,   1000, {s, 0}},
    {coils,             0x3000,    256, {ts, 0}},
    {coils,             0x3200,    256, {cs, 0}},
    {coils,             0x3300,    184, {y, 0}},   // printed Y0-Y255, at 13056-13239: 184 points are Y0-Y267

    {holding_registers, 0x0000,   8000, {d, 0}},   // printed 0000H-1FFFH, which D8000 at 1F40H contradicts
    {holding_registers, 0x1F40,    256, {d, 8000}},
    {holding_registers, 0xA140,    256, {tn, 0}},
    {holding_registers, 0xA340,    200, {cn, 0}},
    {holding_registers, 0xA408,    112, {cn, 200}},
};
// clang-format on

constexpr model made(std::string_view name)
{
    return {.name = name,
            .areas = areas,
            .standard_map = standard_map,
            .functions = ls_functions_over_tcp,
            .user_defined_map = false,
            .serial_functions = ls_functions,
            .channels = ls_channels,
            .one_channel = false,
            .ascii = true,
            .errors = error_style::ls,
            .format = format_style::ls,
            .timers = timer_names::plain};
}

}  // namespace

constinit const model ls22 = made("LS22");
constinit const model ls32 = made("LS32");

}  // namespace plcgw::plc
