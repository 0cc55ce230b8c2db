// PLC program text as instruction lists print it: one instruction in each line, blank lines and text after ";" or "//"
// passed over, upper or lower case, operands parted by blanks or commas, a leading step number if there is one.
#pragma once

#include <cstdint>
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

struct program_line {
    std::size_t line{};                 // 1 = first
    std::optional<std::uint32_t> step;  // printed in front of the instruction
    std::vector<std::string> words;     // instruction and operands in upper case, at least one
};

std::vector<program_line> program_lines(std::string_view text);

// K-32768 to K65535, H0 to HFFFF.
std::optional<std::uint16_t> parse_constant(std::string_view text);

}  // namespace plcgw::plc
