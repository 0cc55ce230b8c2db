// Points, and what a route says beside its way, as structs with their defaults.
#pragma once

#include "bridge/points/point.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

struct point_config {
    std::string name;
    std::string plc;
    std::string device;
    std::optional<unsigned> bit;  // of a word
    value_type type = value_type::int16;
    byte_order order = byte_order::abcd;
    unsigned characters = 0;  // of text
    double scale = 1;
    double offset = 0;
    std::string unit;
    std::optional<double> least;
    std::optional<double> most;
    outside_limits outside = outside_limits::uncertain;
    double deadband = 0;
    double deadband_percent = 0;  // of the span from min to max
    std::chrono::milliseconds longest_silence{60'000};
    bool writable = false;
};

// Devices that a route copies from, instead of a station.
struct copy_source_config {
    std::string plc;
    std::string device;
};

// Where the words of a route or station are shown; no device: nowhere.
struct status_config {
    std::string plc;  // of a route that of the route, if empty
    std::string device;
    byte_order order = byte_order::abcd;  // of the source time
};

struct upstream_config {
    std::chrono::milliseconds longest_silence{0};  // 0 = nobody is missed
    std::vector<unsigned> safe;                    // one for all registers or bits, or one for each
};

enum class loss_policy : std::uint8_t { keep, zero, value };

}  // namespace plcgw
