// The messages of a general-purpose line, made from its configuration.
#pragma once

#include "bridge/messages/line_messages.hpp"
#include "daemon/config/config.hpp"
#include "daemon/running_line.hpp"

namespace plcgw {

// The configuration has no mistakes.
messages::line_messages line_messages_of(const line_config& line, milliseconds longest_silence, const find_plc& plc);

}  // namespace plcgw
