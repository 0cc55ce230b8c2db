// The commands of MEWTOCOL7-COM and their responses: MMRD, MMWT (FP7 serial communication manual 7.2.2) and STRD, which
// an FP7 answers too. Their fields are those of a dialect.
#pragma once

#include "protocols/mewtocol/mewtocol7_dialect.hpp"
#include "protocols/mewtocol/mewtocol7_frame.hpp"
#include "protocols/mewtocol/response.hpp"

namespace plcgw::mewtocol7 {

using mewtocol::executed;
using mewtocol::no_response;
using mewtocol::read_status;
using mewtocol::read_words;
using mewtocol::words_read;
using mewtocol::write_words;

using command = std::variant<read_words, write_words, read_status>;  // MMRD, MMWT, STRD 00

// STRD, as one recorded answer of an FP7 shows it. Every number is hexadecimal, as written.
struct state_read {
    std::uint8_t series = 0x07;  // FP7
    std::uint8_t model{};        // 3: CPS41E, 4: CPS31E, 5: CPS31, 6: CPS41ES, 7: CPS31ES, 8: CPS31S, 9: CPS21
    std::uint16_t special_order{};
    std::uint16_t newest_version{};  // 0x0453 is 4.53
    std::uint16_t communication_version{};
    std::uint16_t operation_version{};
    std::uint8_t mode{};  // bit 0: RUN
    std::uint8_t error_flags{};
    std::uint16_t self_diagnosis{};
    std::uint8_t card{};
    std::string rest;  // 6 characters that no source explains
    bool operator==(const state_read&) const = default;
};

using response = std::variant<words_read, executed, state_read, error_code, no_response>;

// The most words of MMWT in one frame: 1014, as the manual says (1.2.2). MMRD responses go on in further frames.
std::size_t max_words_written(const dialect& d);

// The text behind `#`. Fails with the code that the server answers: 42, 41, 60, 61.
boost::system::result<command, error_code> parse_command(std::string_view text, const dialect& d);

bool is_expressible(const command& c, const dialect& d);         // fits into the fields and one frame
std::string encode_command(const command& c, const dialect& d);  // the text behind `#`; c is expressible

// The text of the response with its mark. Empty for no_response.
std::string encode_response(const command& question, const response& answer, const dialect& d);

// Fails with errc::unexpected_answer. Takes the joined text of all frames.
result<response> parse_response(const command& question, std::string_view text, const dialect& d);

// MMWT blocks longer than one frame as several commands, cut behind an even number of words.
std::optional<std::vector<command>> plan_write(const write_words& block, const dialect& d);

}  // namespace plcgw::mewtocol7
