// What leaves the gateway about one block of registers: the DDS publisher and the status page get this.
#pragma once

#include "bridge/routes/quality.hpp"
#include "protocols/time.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace plcgw {

enum class sample_format : std::uint8_t { words, bits };

struct sample {
    std::string route;                 // name of the route, or of the published block of a PLC
    std::string area;                  // "holding", "input", "coil", "discrete"; or a device name such as "D"
    std::uint32_t first{};             // address of the first register or bit, zero-based
    sample_format format{};            // words: one register per element; bits: 16 per element, lowest address in bit 0
    std::uint32_t count{};             // registers or bits
    std::vector<std::uint16_t> words;  // at most 1024 elements
    quality state{};
    wall_time source{};  // when the device answered
};

}  // namespace plcgw
