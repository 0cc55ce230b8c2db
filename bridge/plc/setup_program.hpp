// The MODBUS part of a PLC program, read as text (FX3 manual 5.2, 5.4 and 9.4): LD M8411 followed by MOVs of constants
// to D8400-D8439 and D8470-D8485. It is checked once, at power-on.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plcgw::plc {

// Something in the text that is no program at all: the gateway does not start with it.
struct program_mistake {
    std::size_t line{};  // of the program text, 1 = first
    std::string text;
};

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
    std::vector<program_mistake> mistakes;
};

// One instruction in each line; blank lines, text after ";" or "//", and a leading step number are passed over.
setup_program parse_setup_program(std::string_view text);

}  // namespace plcgw::plc
