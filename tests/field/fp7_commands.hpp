// The commands of MEWTOCOL-COM that the simulated FP7 knows: RD WD RCS RCP RCC WCS WCP WCC RT (FP7 serial communication
// manual, 7.2.1).
#pragma once

#include "tests/field/fp7_memory.hpp"

#include <string_view>

namespace plcgw::field {

struct refusal {
    std::string_view code;  // two digits of an error response
};

// text: behind `#`. Returns what stands behind `$`, with the command's two letters; throws a refusal, and has then
// changed nothing.
std::string execute(fp7_memory& memory, std::string_view text);

}  // namespace plcgw::field
