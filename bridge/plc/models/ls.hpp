// LS22 and LS32: device ranges and default MODBUS map of the LS manual, section 7-2.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

extern const model ls22;
extern const model ls32;

}  // namespace plcgw::plc
