// The MODBUS part of a PLC program, read as text (FX3 manual 5.2, 5.4 and 9.4): LD M8411 followed by MOVs of constants
// to D8400-D8439 and D8470-D8485. It is checked once, at power-on.
#pragma once

#include "bridge/plc/program_text.hpp"

#include <map>

namespace plcgw::plc {

// Error 0202 of FX3 manual 12.6: the program can be read, but the PLC refuses a parameter.
struct parameter_fault {
    std::uint32_t detail{};  // the D register that is wrong, or M8411 for a void block
    std::size_t line{};
    std::string reason;
};

struct setup_program {
    std::map<std::uint32_t, std::uint16_t> registers;  // D number -> value, of the last LD M8411 only
    std::map<std::uint32_t, std::size_t> lines;        // D number -> line of its MOV
    std::optional<parameter_fault> fault;              // the first one; the register keeps its initial value
    bool is_void = false;                              // the whole block, by caution 3 or 4 of 5.4
    std::vector<program_mistake> mistakes;
};

// ADPRW and what drives it is passed over: adprw_program.hpp reads it.
setup_program parse_setup_program(std::string_view text);

}  // namespace plcgw::plc
