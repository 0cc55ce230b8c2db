// MEWTOCOL-COM responses as structs, and the check that a received one fits the command.
#pragma once

#include "protocols/errc.hpp"
#include "protocols/mewtocol/command.hpp"

namespace plcgw::mewtocol {

struct contacts_read {  // RCS, RCP: in the order asked
    std::vector<bool> values;
    bool operator==(const contacts_read&) const = default;
};

struct words_read {  // RCC, RD, RS, RK, RR
    std::vector<std::uint16_t> values;
    bool operator==(const words_read&) const = default;
};

struct executed {  // writes, fills, MC, MD, RM: the response is the command's name
    bool operator==(const executed&) const = default;
};

struct monitored {     // MG
    unsigned scans{};  // since the last MG; 10 stands for ten or more
    buffer contacts;   // eight in a byte, the first registered is bit 0 of the first byte
    std::vector<std::uint16_t> words;
    bool operator==(const monitored&) const = default;
};

// RT. An FP7 says its mode and its errors only, everything else is 0.
struct plc_status {
    std::uint8_t model{};     // 0x20: FP-X, FP sigma ...; 0x02: FP5 ... (mewtocol notes of the maker's manuals)
    std::uint8_t version{};   // 0x25 is 2.5
    std::uint8_t capacity{};  // thousands of steps, 0 to 99
    std::uint8_t mode{};      // bit 0: RUN, bit 7: remote mode
    std::uint8_t link{};
    std::uint8_t error_flags{};  // bit 0: self-diagnosis, 5: battery, 7: operation error
    std::uint16_t self_diagnosis{};
    bool operator==(const plc_status&) const = default;
};

struct status_read {
    plc_status status;
    bool operator==(const status_read&) const = default;
};

struct extended_status_read {  // EX00RT; status.model is the machine code, status.link as in RT
    plc_status status;
    std::uint8_t hardware{};  // bits: user ROM, IC card, -, general memory, fast CPU
    std::string rest;         // 30 characters: number and sizes of the programs, and what no source explains
    bool operator==(const extended_status_read&) const = default;
};

struct no_response {  // nobody answers AB, nor what was sent to the global station
    bool operator==(const no_response&) const = default;
};

using response = std::variant<contacts_read, words_read, executed, monitored, status_read, extended_status_read,
                              error_code, no_response>;

// The text of the response, with its mark: `$` and two letters or `!` and two digits. Empty for no_response.
std::string encode_response(const command& question, const response& answer);

// Fails with errc::unexpected_answer unless mark, letters, length and digits fit the question. Takes the joined text of
// all frames.
result<response> parse_response(const command& question, std::string_view text);

// Whether somebody answers.
bool expects_answer(station_id station, const command& question);

}  // namespace plcgw::mewtocol
