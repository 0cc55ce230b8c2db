// Internal to bridge/dds: what came, and what went away, as values of ours.
#pragma once

#include "bridge/dds/event.hpp"
#include "messages.h"
#include "registers.h"

namespace plcgw {

dds_event received(const plcgw_v1_RegisterBlock& in);
dds_event received(const plcgw_v1_Point& in);
dds_event received(const plcgw_v1_GatewayStatus& in);
dds_event received(const plcgw_v1_PortStatus& in);
dds_event received(const plcgw_v1_DeviceStatus& in);
dds_event received(const plcgw_v1_SerialMessage& in);
dds_event received(const plcgw_v1_Event& in);

// Of state topics: an event has no instance that could go away.
dds_event gone(const plcgw_v1_RegisterBlock& key, gone_reason reason);
dds_event gone(const plcgw_v1_Point& key, gone_reason reason);
dds_event gone(const plcgw_v1_GatewayStatus& key, gone_reason reason);
dds_event gone(const plcgw_v1_PortStatus& key, gone_reason reason);
dds_event gone(const plcgw_v1_DeviceStatus& key, gone_reason reason);

}  // namespace plcgw
