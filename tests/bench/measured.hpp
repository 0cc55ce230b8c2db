// What happened on one wire in a window of time. The window that counts runs from the end of its first response to the
// end of its last one: no transaction is cut.
#pragma once

#include "tests/bench/wire_format.hpp"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace plcgw::bench {

struct answered_request {
    std::uint8_t unit;
    std::uint8_t function;
    unsigned first;
    nanoseconds ideal;  // silence, request, turnaround and response
    nanoseconds end;
    std::optional<unsigned> value;  // of the first register of a read
};

struct seen_value {
    std::uint8_t unit;
    unsigned first;
    unsigned value;   // of the first register
    nanoseconds end;  // of the request that writes it, or of the response that shows it
};

class measured {
public:
    void note_silence(nanoseconds silence, nanoseconds rule, bool after_response);
    void note_answer(const answered_request& answered);
    void note_write(const seen_value& seen) { writes_.push_back(seen); }

    std::uint64_t requests = 0;
    std::uint64_t unanswered = 0;
    std::uint64_t collisions = 0;     // a byte sent while another one was on the wire, or about to be
    std::uint64_t torn_requests = 0;  // more than 1.5 characters between two bytes of one
    std::uint64_t bad_requests = 0;

    nlohmann::json report() const;
    void begin();  // a new window

private:
    std::uint64_t answered_ = 0;
    std::uint64_t short_silences_ = 0;
    nanoseconds least_silence_ = INT64_MAX;
    nanoseconds first_end_ = 0;
    nanoseconds last_end_ = 0;
    nanoseconds ideal_ = 0;                                                // of the responses after the first
    nanoseconds longest_ = 0;                                              // transaction
    std::vector<nanoseconds> excess_;                                      // silence after a response beyond the rule
    std::map<unsigned, std::pair<std::uint64_t, nanoseconds>> units_;      // responses and ideal time of each
    std::map<unsigned, std::pair<std::uint64_t, nanoseconds>> functions_;  // the same
    std::vector<seen_value> writes_;
    std::vector<seen_value> changes_;                            // of what reads of a block show
    std::map<std::pair<unsigned, unsigned>, unsigned> shown_;    // the latest, windows do not matter
    std::set<std::tuple<unsigned, unsigned, unsigned>> blocks_;  // ever answered, windows do not matter
    nanoseconds last_new_block_ = 0;
};

}  // namespace plcgw::bench
