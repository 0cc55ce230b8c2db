// The applicability table of ADPRW: FX3 manual 8.3, LS manual 6-3.
#pragma once

#include "bridge/plc/model.hpp"

namespace plcgw::plc {

// What S4/D may be.
namespace operands {
inline constexpr unsigned registers = 1;  // D, R
inline constexpr unsigned relays = 2;     // M, Y, S
inline constexpr unsigned inputs = 4;     // X
inline constexpr unsigned constants = 8;  // K, H
}  // namespace operands

struct command_row {
    modbus::function code;
    std::uint16_t s3_least;  // 0 and 0: "0 (fixed)"
    std::uint16_t s3_most;
    unsigned s4;
};

// Sub-functions of 08, their S3. A restart takes the two ends of its range only.
struct diagnostic_row {
    modbus::diagnostic code;
    std::uint16_t s3_most;
};

const command_row* find_command(const model& m, std::uint16_t code);  // null: this PLC does not ask it
const diagnostic_row* find_diagnostic(std::uint16_t code);

inline constexpr std::uint16_t highest_unit = 247;
inline constexpr std::uint16_t event_log_words = 32;  // of function 0C, two events in each

}  // namespace plcgw::plc
