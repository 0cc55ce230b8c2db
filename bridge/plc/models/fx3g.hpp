// FX3G and FX3GC: device ranges and default MODBUS map of the FX3 manual, section 9.3.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

extern const model fx3g;
extern const model fx3gc;

}  // namespace plcgw::plc
