// The rows of a general-purpose line: where its messages go, what is cut out of them, and what is sent.
#pragma once

#include "bridge/messages/message_reader.hpp"
#include "bridge/plc_block.hpp"
#include "protocols/general_purpose/exchange.hpp"
#include "protocols/general_purpose/receive_buffers.hpp"

namespace plcgw::messages {

struct plc_bit {
    plc::simulated_plc* plc = nullptr;
    plc::place at;

    bool level() const { return plc != nullptr && plc->memory().bit(at); }
    bool touched_by(const plc::simulated_plc& who, const plc::change& changed) const
    {
        return plc == &who && plc::overlaps(changed, at, 1);
    }
};

// What GPRECV does: whole messages in words, the count of bytes first.
struct raw_row {
    plc_block into;
    plc_bit ready;  // without one each message replaces the one before
    general_purpose::when_full policy = general_purpose::when_full::drop;
};

// Numbers and text of the messages of one pattern, each in a place of its own.
struct message_row {
    std::string name;
    pattern form;
    std::vector<field> fields;
    std::vector<plc_block> into;  // for each field
    duration longest_silence{};   // after it the values are stale; 0 = never
    std::string answer_to;        // name of a sending: nothing else is read by this pattern
};

struct send_row {
    std::string name;
    buffer text;      // or else
    plc_block words;  // as GPSEND has them: the count of bytes first
    duration period{};
    plc_bit trigger;
    general_purpose::expect answer = general_purpose::expect::nothing;
    duration response_timeout{};
};

}  // namespace plcgw::messages
