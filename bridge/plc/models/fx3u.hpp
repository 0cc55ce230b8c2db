// FX3U and FX3UC: device ranges and default MODBUS map of the FX3 manual, section 9.3.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

extern const model fx3u;
extern const model fx3uc;

}  // namespace plcgw::plc
