// What leaves the gateway about one message of a general-purpose line, received or sent.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/time.hpp"

#include <string>

namespace plcgw {

enum class message_direction : std::uint8_t { received, sent };

struct serial_message {
    std::string line;
    message_direction way{};
    std::string name;    // of the pattern that took it, or of the sending; empty: none
    std::string reason;  // why no pattern took it; empty: nothing is wrong
    buffer content;      // without start and end codes
    wall_time when{};    // its end was heard, or it was handed to the driver
};

}  // namespace plcgw
