// FP7: device ranges and MODBUS map of the FP7 serial communication manual, sections 4.1, 4.2 and 8.2.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

extern const model fp7;

// Where the CPU unit's ports show what the instruction PMGET reads (10.3): COM.n from UM(100 n) on 26 words of
// parameters, from UM(100 n + 50) on 7 words of monitor information. The manual gives no place, this one is ours.
inline constexpr std::uint32_t pmget_step = 100;
inline constexpr std::uint32_t pmget_monitor = 50;

}  // namespace plcgw::plc
