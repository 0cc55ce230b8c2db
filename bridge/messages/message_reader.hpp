// Reads the fields of the messages of one route: all fields of a message, or none of it.
#pragma once

#include "bridge/messages/field.hpp"

namespace plcgw::messages {

struct read_counters {
    std::uint64_t matched = 0;    // their fields were stored
    std::uint64_t unmatched = 0;  // not of the pattern
    std::uint64_t unfit = 0;      // of the pattern, but with a value that its type cannot hold
};

// A message that was not stored, for the status page.
struct refused_message {
    std::string message;  // printable, its first 256 bytes
    std::string reason;
};

// What is wrong between pattern and fields, one sentence each: names that the pattern has not, text stored as a number,
// decimals and sizes out of range.
std::vector<std::string> mistakes_of(const pattern& p, const std::vector<field>& fields);

class message_reader {
public:
    message_reader(pattern p, std::vector<field> fields);  // mistakes_of() found none

    // True when the words of all fields are new. Else they keep what they hold, and the message is counted and kept.
    bool read(bytes message);

    const std::vector<field>& fields() const { return fields_; }
    const_words words_of(std::size_t index) const;  // zeros before the first message

    const read_counters& counters() const { return counters_; }
    const std::optional<refused_message>& last_refused() const { return last_refused_; }

private:
    void refuse(bytes message, std::string reason);

    pattern pattern_;
    std::vector<field> fields_;
    std::vector<std::size_t> captures_;  // of the pattern, for each field
    std::vector<std::size_t> first_;     // word of each field, and the end
    std::vector<std::uint16_t> words_;
    std::vector<std::uint16_t> fresh_;  // of the message being read
    read_counters counters_;
    std::optional<refused_message> last_refused_;
};

}  // namespace plcgw::messages
