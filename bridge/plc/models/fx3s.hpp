// FX3S: device ranges and default MODBUS map of the FX3 manual, section 9.3 of its later (Chinese) edition.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

extern const model fx3s;

}  // namespace plcgw::plc
