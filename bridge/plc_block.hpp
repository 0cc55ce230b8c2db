// Devices of a PLC that are published as one block, whoever wrote them.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/sample.hpp"

namespace plcgw {

struct plc_block {
    std::string name;  // "main.D0"
    plc::simulated_plc* plc = nullptr;
    plc::device head;
    plc::place at;
    std::uint32_t count{};  // registers, or bits of a bit device
};

bool touches(const plc_block& b, const plc::simulated_plc& plc, const plc::change& changed);
std::size_t bits_of(const plc_block& b);
sample sample_of(const plc_block& b, wall_time now);  // good: what routes say of its devices is the caller's to add

}  // namespace plcgw
