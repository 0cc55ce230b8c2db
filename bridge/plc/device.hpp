// A PLC device name with its number, as the manuals write it: D1000, X17 (octal), CN200.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace plcgw::plc {

// TS / CS are the contacts of timers and counters, TN / CN their current values.
enum class device_kind : std::uint8_t { x, y, m, s, ts, cs, d, r, tn, cn };

struct device {
    device_kind kind{};
    std::uint32_t number{};  // X and Y: the point, X17 is number 15
    bool operator==(const device&) const = default;
};

std::string_view to_string(device_kind kind);  // "D", "TS", ...
std::string to_string(device d);               // X and Y in octal

// Upper or lower case; nothing when the text is no device name. X8 is none: 8 is no octal digit.
std::optional<device> parse_device(std::string_view text);

constexpr bool is_bit_kind(device_kind kind) { return kind < device_kind::d; }

}  // namespace plcgw::plc
