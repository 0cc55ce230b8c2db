// `plc-gateway doctor dds`: why readers and gateways do not find each other.
#pragma once

#include "bridge/dds/settings.hpp"

namespace plcgw {

// Looks and listens for so many seconds. Exit code: 0, or 1 when something is wrong or nobody is there.
int doctor_dds(const dds_settings& settings, unsigned seconds);

}  // namespace plcgw
