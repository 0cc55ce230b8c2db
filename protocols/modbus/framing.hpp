// The two transmission modes of MODBUS over Serial Line V1.02 section 2.5.
#pragma once

#include "protocols/modbus/types.hpp"

namespace plcgw::modbus {

enum class framing : std::uint8_t { rtu, ascii };

// The delimiter is that of ASCII frames.
buffer encode_adu(framing mode, const frame& f, std::uint8_t delimiter);

}  // namespace plcgw::modbus
