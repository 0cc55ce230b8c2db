// A PLC's MODBUS map read both ways: which numbers lead to a device, and which devices stand behind a number.
#pragma once

#include "bridge/plc/modbus_map.hpp"

#include <span>
#include <string>
#include <vector>

namespace plcgw::plc {

using map_rows = std::span<const map_row>;

// One coil, input or register.
struct map_address {
    modbus::table table{};
    std::uint32_t number{};  // zero-based
    bool operator==(const map_address&) const = default;
};

// Where a device is found.
struct device_address {
    map_address at;
    std::uint32_t count = 1;      // two registers for a 32-bit device, low word first; 16 coils for a word of contacts
    std::optional<unsigned> bit;  // inside the register, of a bit device
    bool operator==(const device_address&) const = default;
};

// What a number leads to: a device, 16 bit devices in a register, or half of a 32-bit device.
struct map_target {
    enum class part : std::uint8_t { whole, low_word, high_word };

    device first;
    device last;
    unsigned first_bit = 0;  // of the register, where bit devices begin
    part of_device = part::whole;
    bool operator==(const map_target&) const = default;
};

// In the order of the tables. Empty when no number leads to the device.
std::vector<device_address> addresses_of(const model& m, map_rows rows, device d);

// Nothing when the number is unused: exception 02.
std::optional<map_target> target_of(const model& m, map_rows rows, map_address at);

// Devices behind a whole row, as far as they exist.
map_target target_of(const model& m, const map_row& row);

// "T5" as LS writes it, "TS5" or "TN5" elsewhere.
std::string name_of(const model& m, device d);
std::string names_of(const model& m, device first, device last);  // "M0-M15", "D0"
std::string ranges_of(const model& m, device_kind kind);          // "D0-D7999, D8000-D8511"

// 40001 and 400001 for holding register 0; the short form ends at 49999 and is empty behind it.
struct reference {
    std::string five_digits;
    std::string six_digits;
};
reference reference_of(map_address at);

}  // namespace plcgw::plc
