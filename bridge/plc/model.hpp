// A PLC family as tables: its device areas and the MODBUS addresses that lead to them by default. A new model is a new
// table in bridge/plc/models/.
#pragma once

#include "bridge/plc/device.hpp"
#include "bridge/plc/special_registers.hpp"
#include "protocols/modbus/types.hpp"

#include <span>
#include <string_view>

namespace plcgw::plc {

// Devices of one kind with consecutive numbers. Special M and D are areas of their own, and so are 32-bit counters.
struct area {
    device_kind kind;
    std::uint32_t first;                    // number of the first device
    std::uint32_t count;                    // devices
    std::uint32_t bits_per_device;          // 1, 16 or 32
    std::uint32_t absent = 0;               // the first so many do not exist: they fill up a register of bit devices
    std::optional<device_kind> words = {};  // another name for 16 of these bits: WX0 is X0-XF. Such areas begin at 0
};

// Devices with consecutive numbers.
struct device_run {
    device first;
    std::uint32_t count;
};

// A run of MODBUS numbers and the devices behind it (FX3 manual 9.3). In a register table a bit area takes one register
// for 16 devices, in a 32-bit area a device takes two registers, low word first.
struct map_row {
    modbus::table table;
    std::uint32_t first;  // MODBUS number, zero-based
    std::uint32_t count;  // coils, inputs or registers
    device head;          // behind the first of them
};

enum class error_style : std::uint8_t {
    fx3,  // 201 to 218 and a register for details (FX3 manual 12.6)
    ls,   // 2xxyy, 3xxyy, 4xxyy, 218x: code and details in one (LS manual 9-6)
};

enum class format_style : std::uint8_t {
    fx3,  // format and protocol in two registers: D8400 and D8401
    ls,   // both in one
};

// Names of timers and counters: contacts TS, CS and values TN, CN, or T and C for both.
enum class timer_names : std::uint8_t { contact_and_value, plain };

enum class transport : std::uint8_t { serial, tcp };

struct model {
    std::string_view name;  // "FX3U"
    std::span<const area> areas;
    std::span<const map_row> standard_map;
    std::span<const modbus::function> functions;         // that a server answers over TCP
    bool user_defined_map;                               // D8470-D8485 exist (FX3 manual 9.4)
    std::span<const modbus::function> serial_functions;  // that a server answers on a serial line, and a client asks
    std::span<const channel> channels;
    bool one_channel;  // of all channels only the first that is set to MODBUS operates (FX3 manual 6.1, D8401)
    bool ascii;        // besides RTU, and 7 data bits with it
    error_style errors;
    format_style format;
    timer_names timers;
    device_names names = fx_device_names;
    std::string_view examples = "D100, M0 or X17 (octal)";  // of devices, for somebody who wrote none
    bool programs = true;                                   // takes a setup program and ADPRW instructions
    bool mewtocol = false;                                  // answers MEWTOCOL-COM and MEWTOCOL7-COM
    std::span<const device_run> status = {};                // where it shows its communication: not for routes to write
};

inline constexpr std::uint32_t special_first = 8000;  // M8000 and D8000: the system's own devices

bool answers(const model& m, modbus::function f, transport over);

bool exists(const model& m, device d);

// The device's first bit in the image of an area; nothing when the area has no such device.
std::optional<std::size_t> first_bit(const area& of, device d);

// Bits that a device of this kind takes in an area that has it.
std::size_t bits_of(const area& a, device_kind kind);

const model* find_model(std::string_view name);  // upper or lower case; null when there is none
std::span<const model* const> all_models();

}  // namespace plcgw::plc
