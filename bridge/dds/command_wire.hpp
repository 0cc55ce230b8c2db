// Internal to bridge/dds: requests and replies as the structs of registers.idl and messages.idl, and back.
#pragma once

#include "bridge/dds/order_request.hpp"
#include "messages.h"
#include "registers.h"

namespace plcgw {

order_request received(const plcgw_v1_WriteRequest& in);
order_request received(const plcgw_v1_PointWriteRequest& in);
order_request received(const plcgw_v1_SerialSendRequest& in);
order_reply received(const plcgw_v1_WriteReply& in);

// Sequences are lent: `from` has to live as long as `to`. False when they, or names, are longer
// than the type has room for.
bool fill(plcgw_v1_WriteRequest& to, const order_request& from);
bool fill(plcgw_v1_PointWriteRequest& to, const order_request& from);
bool fill(plcgw_v1_SerialSendRequest& to, const order_request& from);
void fill(plcgw_v1_WriteReply& to, const order_reply& from);

}  // namespace plcgw
