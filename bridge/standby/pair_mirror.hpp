// What the active member of a pair lets the other one know, so that it can go on with the same values.
#pragma once

#include "bridge/routes/quality.hpp"
#include "protocols/time.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace plcgw {

// Registers of an area of a PLC's memory, 16 bit devices in each.
struct memory_chunk {
    static constexpr std::size_t size = 128;  // registers; the last chunk of an area is shorter

    std::string plc;
    std::uint32_t area{};
    std::uint32_t first{};  // register in the area, a multiple of `size`
    std::uint64_t term{};   // of who says so
    std::vector<std::uint16_t> words;
    bool operator==(const memory_chunk&) const = default;
};

// What is known of a route, beside the devices that it fills.
struct route_record {
    std::string route;
    bool writes = false;  // of a route that reads and writes: its writing half
    std::uint64_t term{};
    quality state{};
    wall_time source{};
    std::uint16_t reason_code{};
    std::uint32_t answers{};
    std::uint32_t errors{};
    std::string reason;
    std::vector<std::uint16_t> words;  // what its station has, as far as that is known
    bool operator==(const route_record&) const = default;
};

}  // namespace plcgw
