// Exchanges of MEWTOCOL-COM: what the bytes mean, and what a station with that memory answers.
#pragma once

#include "tests/unit/mewtocol_fake.hpp"

namespace plcgw::test {

struct vector_row {
    const char* id;
    enum class start : std::uint8_t { alone, then } from;  // then: the memory is as the row above left it
    void (*setup)(mewtocol_bench&);
    std::string request;                     // without CR
    std::string response;                    // without CR; empty: nobody answers
    std::optional<mewtocol::command> asked;  // nothing: the station refuses it unparsed
    std::optional<mewtocol::response> answer;
};

const std::vector<vector_row>& com_vectors();

// The station as the row finds it. Call for all rows in their order.
inline void prepare(mewtocol_bench& b, const vector_row& row)
{
    if (row.from == vector_row::start::alone)
        b = mewtocol_bench{};
    if (row.setup != nullptr)
        row.setup(b);
}

}  // namespace plcgw::test
