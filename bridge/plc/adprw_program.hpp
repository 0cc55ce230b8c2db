// The ADPRW instructions of a PLC program, read as text (FX3 manual 8.2 and 10.2, LS manual 6-2).
//
//     LD M8000                      while the contact is on, one after another, again and again:
//     ADPRW H5 H3 H0 K10 D100       station, command code, S2, S3, and S4 or D of section 8.3
//     LDP M0                        once when M0 comes on; LDF: goes off
//     MOV K500 D8409                constants and registers, below the contacts, in the order of the program
//     ADPRW H5 H10 K0 K4 R0
//     LD M8002                      once after power-on and after STOP to RUN
//     ADPRWP H0 H6 K1 K0 K55        the P of LS: once when its contact comes on
//
// LD, LDI, LDP and LDF begin a rung and are its only contact. Operands are K, H, D, R, M, X, Y, S without index
// registers. MOV takes K, H, D or R to D or R. Everything else in a program (OUT, SET, other MOVs, ...) takes its steps
// and is not run. M8000 to M8003 are the system's, every other contact is a device in memory.
#pragma once

#include "bridge/plc/device.hpp"
#include "bridge/plc/program_text.hpp"

#include <array>
#include <variant>

namespace plcgw::plc {

using operand = std::variant<std::uint16_t, device>;  // a constant, or what is in a device

struct contact {
    enum class kind : std::uint8_t { open, closed, rising, falling };  // LD, LDI, LDP, LDF
    kind how{};
    device at;
    bool operator==(const contact&) const = default;
};

struct mov {
    operand from;
    device to;
    bool operator==(const mov&) const = default;
};

struct adprw {
    std::array<operand, 5> operands;  // S, S1, S2, S3, S4/D
    bool operator==(const adprw&) const = default;
};

struct instruction {
    std::size_t line{};    // of the text
    std::uint16_t step{};  // the printed number, else counted from the lengths of the instructions above
    contact driven_by;
    bool once{};  // for each edge, not again and again
    std::variant<mov, adprw> what;
    bool operator==(const instruction&) const = default;
};

struct adprw_program {
    std::vector<instruction> instructions;  // in the order of the text
    std::vector<program_mistake> mistakes;

    bool asks() const;  // there is an ADPRW
};

// Says nothing about instructions that it does not know: parse_setup_program() reads the same text and does.
adprw_program parse_adprw_program(std::string_view text);

}  // namespace plcgw::plc
