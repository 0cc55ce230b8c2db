// Quality on the wire: the QUALITY_* codes of registers.idl.
#pragma once

#include "bridge/routes/quality.hpp"

#include <cstdint>

namespace plcgw {

std::uint16_t quality_code(quality q);

// Codes that this version does not know are judged by their range: < 64 bad, < 192 uncertain, else good.
quality quality_from_code(std::uint16_t code);

}  // namespace plcgw
