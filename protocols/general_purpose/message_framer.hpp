// Cuts messages out of what a general-purpose line brings: FP7 serial communication manual 9.4.2 and 9.5.
#pragma once

#include "protocols/framer.hpp"
#include "protocols/general_purpose/message_form.hpp"

#include <deque>

namespace plcgw::general_purpose {

// A message is what stands between the codes, without them; it may be empty. With a start code, bytes that come without
// one are a message all the same, and each start code begins it anew (9.5.2).
//
// A silence can be shorter than what can be seen: drivers, and adapters above all, deliver in packets of 1 to 16 ms.
// Bytes fed with one call belong together, and so do bytes of several calls when next() was not asked at deadline() in
// between. Two messages with less silence between them than one packet takes come out as one.
class message_framer {
public:
    using frame_type = buffer;

    explicit message_framer(const message_form& form) : form_(form) {}

    void feed(time_point now, bytes received);

    // The character behind those fed so far is lost: errc::bad_parity, bad_stop_bit or overrun. The message around it
    // is dropped up to its end. If it was an end code itself, nobody can know: the next message is dropped with it.
    void fault(time_point now, errc why);

    // A message, or why bytes were dropped, once for each message: overlong (more than max_message_size bytes with the
    // codes), restarted, incomplete (abandoned), or a fault.
    std::optional<result<buffer>> next(time_point now);
    time_point deadline() const;

    void reset();    // channel reset (4.1, Y10): forgets what was received and not asked for
    void abandon();  // the message that is being received

    bool inside() const { return inside_; }  // a message that has not ended yet
    time_point heard() const { return heard_; }

private:
    void take(std::uint8_t byte);
    bool ends(std::uint8_t byte) const;
    void end();
    void lose(errc why);

    message_form form_;
    std::deque<result<buffer>> ready_;
    buffer content_;
    std::size_t size_ = 0;   // with its codes
    std::uint8_t last_ = 0;  // byte of the message
    bool inside_ = false;
    bool skipping_ = false;  // the rest of a message that is lost
    time_point heard_{};
};

}  // namespace plcgw::general_purpose
