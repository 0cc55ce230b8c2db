// What a client wants of devices in a row, whatever number of commands that takes; and the commands that it takes.
#pragma once

#include "protocols/mewtocol/device.hpp"
#include "protocols/mewtocol/mewtocol7_message.hpp"
#include "protocols/mewtocol/plan.hpp"

namespace plcgw::mewtocol {

struct read_run {  // contacts
    contact first{};
    std::uint32_t count{};
    bool operator==(const read_run&) const = default;
};

struct write_run {
    contact first{};
    std::vector<bool> values;
    bool operator==(const write_run&) const = default;
};

using block = std::variant<read_words, write_words, read_run, write_run>;

// Which header a client uses. Every station knows `%`; `<` carries more.
enum class headers : std::uint8_t {
    automatic,  // `<` where it saves commands
    normal,
};

struct planned {
    header head{};
    std::vector<command> commands;
    bool operator==(const planned&) const = default;
};

// The commands in their order. Contacts X, Y, R and L are read as the words that hold them, of one moment unless they
// need several commands, but a single one with RCS; T and C eight at a time. Whole words of contacts are written as
// words, the others eight contacts at a time. Nothing if there is no command for it or the numbers do not fit.
std::optional<planned> plan(const block& b, headers which);

// MEWTOCOL7-COM knows words only: no T and C, and contacts are written in whole words or not at all.
std::optional<std::vector<mewtocol7::command>> plan(const block& b, const mewtocol7::dialect& d);

// The block's answer from those of all its commands, none of them an error.
response join(const block& b, const std::vector<response>& parts);

// A MEWTOCOL7-COM answer in the words of MEWTOCOL-COM. STRD has none.
response as_response(mewtocol7::response answer);

}  // namespace plcgw::mewtocol
