// What a MEWTOCOL line has beside the settings of every line.
#pragma once

#include "protocols/mewtocol/mewtocol7_dialect.hpp"

#include <chrono>

namespace plcgw {

// fp7: those of FP7 manual 7.2.1; all: those of the whole FP family, as far as an FP7 has the devices.
enum class mewtocol_commands : std::uint8_t { fp7, all };

struct mewtocol_config {
    mewtocol_commands commands = mewtocol_commands::fp7;
    bool expansion = true;       // the header `<`
    bool several_frames = true;  // `%` messages in several frames
    std::chrono::milliseconds rest_kept{30'000};
    unsigned max_contacts = 80;
    unsigned max_words = 16;
    mewtocol7::dialect dialect;
};

}  // namespace plcgw
