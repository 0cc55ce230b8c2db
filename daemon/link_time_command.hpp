// `plc-gateway linktime`: how long one question takes between two PLCs, part by part (FX3 manual 2.2), or one round of
// a PLC link of FP PLCs (FP7 manual 6.4).
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace plcgw {

struct link_time_options {
    unsigned baud_rate = 19200;
    std::string bits = "8N1";
    std::string framing = "rtu";  // or ascii
    std::string function = "3";   // decimal, or hexadecimal behind 0x
    std::size_t count = 1;
    std::size_t write_count = 1;  // of function 0x17
    double delay_ms = 0;          // D8411
    double scan_ms = 10;
    double server_delay_ms = 10;
    std::optional<std::size_t> request_bytes;  // instead of what function and count say
    std::optional<std::size_t> response_bytes;

    unsigned link_stations = 0;           // 2 to 16: a PLC link; 0: a question
    unsigned absent = 0;                  // of them
    std::optional<unsigned> relay_words;  // that each sends; nothing: an equal share of the 64, and of the 128
    std::optional<unsigned> register_words;
};

// Exit status: 0, or 1 when an option is wrong.
int show_link_time(const link_time_options& options);

}  // namespace plcgw
