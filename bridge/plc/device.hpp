// A PLC device name with its number, as the manuals write it: D1000, X17 (octal), R2047F (word 2047, bit 15).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace plcgw::plc {

// What a device is. How it is called is the family's: data registers are D to an FX3 and DT to an FP7.
enum class device_kind : std::uint8_t {
    // Bits
    x,           // inputs
    y,           // outputs
    m,           // internal relays of FX3 and LS
    s,           // states
    ts,          // contacts of timers
    cs,          // and of counters
    relay,       // internal relays of FP7
    link_relay,  // of a PLC link
    // Words
    d,   // data registers
    r,   // extension registers
    tn,  // current values of timers: elapsed values in FP7
    cn,  // and of counters
    timer_set,
    counter_set,
    ld,  // link registers
    wx,  // contacts of FP7, 16 at a time
    wy,
    wr,
    wl,
    um,  // unit memory
};

constexpr bool is_bit_kind(device_kind kind) { return kind < device_kind::d; }

struct device {
    device_kind kind{};
    std::uint32_t number{};  // of contacts the point: X17 is number 15, R1F number 31
    bool operator==(const device&) const = default;
};

enum class numbering : std::uint8_t {
    decimal,
    octal,
    word_and_bit,  // a decimal word, left out when 0, and one hexadecimal digit for the bit: XA, X1F
};

struct device_name {
    device_kind kind;
    std::string_view name;  // upper case
    numbering digits = numbering::decimal;
};

// The names of one family. A kind that stands twice is read by either name and printed by the first.
using device_names = std::span<const device_name>;

// FX3 and LS. The texts of their programs have these too.
// clang-format off
inline constexpr device_name fx_device_names[] = {
    {device_kind::x,  "X", numbering::octal},
    {device_kind::y,  "Y", numbering::octal},
    {device_kind::m,  "M"},
    {device_kind::s,  "S"},
    {device_kind::ts, "TS"},
    {device_kind::cs, "CS"},
    {device_kind::d,  "D"},
    {device_kind::r,  "R"},
    {device_kind::tn, "TN"},
    {device_kind::cn, "CN"},
};
// clang-format on

// "D", "TS", ... The family has such devices; else std::logic_error.
std::string_view to_string(device_kind kind, device_names names = fx_device_names);
std::string to_string(device d, device_names names = fx_device_names);

// Upper or lower case; nothing when the text is no device name of the family. To an FX3, X8 is none: 8 is no octal
// digit.
std::optional<device> parse_device(std::string_view text, device_names names = fx_device_names);

// The row of the family with the longest name that the text begins with, whatever follows; null when there is none.
const device_name* find_name(std::string_view text, device_names names);

}  // namespace plcgw::plc
