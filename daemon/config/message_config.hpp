// The messages of a general-purpose line as structs, with their defaults.
#pragma once

#include "bridge/messages/field.hpp"
#include "protocols/general_purpose/message_form.hpp"
#include "protocols/general_purpose/receive_buffers.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

// Words in a PLC for whole messages.
struct received_config {
    std::string name;
    std::string plc;
    std::string device;
    unsigned count = 1;
    std::string ready;  // bit of the same PLC; empty: no handshake
    general_purpose::when_full when_full = general_purpose::when_full::drop;
};

struct field_config {
    std::string name;
    std::string device;
    messages::value_type type = messages::value_type::int32;
    unsigned decimals = 0;
    unsigned characters = 0;
    messages::word_order order = messages::word_order::low_first;
};

struct message_config {
    std::string name;
    std::string pattern;
    std::string plc;
    std::vector<field_config> fields;
    std::chrono::milliseconds longest_silence{0};  // 0 = a message may stay away for ever
    std::string answer_to;                         // a sending of the same line
};

struct send_config {
    std::string name;
    std::string text;    // or words of a PLC
    std::string plc;     // of words and trigger
    std::string device;  // first of the words
    unsigned count = 0;
    std::string trigger;                  // bit of the PLC
    std::chrono::milliseconds period{0};  // 0 = not periodically
    bool answer = false;
    std::optional<std::chrono::milliseconds> response_timeout;  // of the line, if absent
};

// Of the line as a whole.
struct message_status_config {
    std::string plc;
    std::string device;  // first of the status words; empty: none
    std::string reset;   // bit of the PLC that resets the channel; empty: none
};

struct general_purpose_config {
    general_purpose::start_code start = general_purpose::start_code::none;
    general_purpose::end_code end = general_purpose::end_code::cr;
    std::chrono::microseconds end_silence{0};  // of end code "silence"; 0 = 32 bits
    std::chrono::milliseconds abandon{0};      // 0 = never
    std::chrono::milliseconds send_wait{0};
    std::vector<received_config> received;
    std::vector<message_config> messages;
    std::vector<send_config> sends;
    bool dds_sends = false;  // DDS clients may send messages, too
    message_status_config status;
};

}  // namespace plcgw
