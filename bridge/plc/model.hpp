// A PLC family as tables: its device areas and the MODBUS addresses that lead to them by default. A new model is a new
// table in bridge/plc/models/.
#pragma once

#include "bridge/plc/device.hpp"
#include "protocols/modbus/types.hpp"

#include <span>
#include <string_view>

namespace plcgw::plc {

// Devices of one kind with consecutive numbers. Special M and D are areas of their own, and so are 32-bit counters.
struct area {
    device_kind kind;
    std::uint32_t first;            // number of the first device
    std::uint32_t count;            // devices
    std::uint32_t bits_per_device;  // 1, 16 or 32
};

// A run of MODBUS numbers and the devices behind it (FX3 manual 9.3). In a register table a bit area takes one register
// for 16 devices, in a 32-bit area a device takes two registers, low word first.
struct map_row {
    modbus::table table;
    std::uint32_t first;  // MODBUS number, zero-based
    std::uint32_t count;  // coils, inputs or registers
    device head;          // behind the first of them
};

struct model {
    std::string_view name;  // "FX3U"
    std::span<const area> areas;
    std::span<const map_row> standard_map;
    std::span<const modbus::function> functions;  // that a server answers
    bool user_defined_map;                        // D8470-D8485 exist (FX3 manual 9.4)
};

inline constexpr std::uint32_t special_first = 8000;  // M8000 and D8000: the system's own devices

const model* find_model(std::string_view name);  // upper or lower case; null when there is none
std::span<const model* const> all_models();

}  // namespace plcgw::plc
