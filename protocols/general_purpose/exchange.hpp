// What a general-purpose line does next, as state machines: one asks a device and waits for its message, one only
// listens. Whoever drives the line does what next() says. FP7 serial communication manual 9.1; sending and receiving
// know nothing of each other there, so the framer belongs to the line and outlives them.
#pragma once

#include "protocols/general_purpose/message_framer.hpp"

#include <utility>
#include <variant>
#include <vector>

namespace plcgw::general_purpose {

struct line_action {
    struct send {
        bytes message;  // valid until the next call of next()
    };
    struct wait {
        time_point until;  // or until bytes come
    };
    struct done {};
    using action = std::variant<send, wait, done>;
};

struct exchange_options {
    character_format format;
    duration response_timeout{500'000};  // from the last byte of the request to the first of the answer
    unsigned retries = 1;                // after the first attempt
    duration send_wait{};                // before each sending (9.2.1): 0 to 100 ms
    duration gap{};                      // silence before sending, for two-wire lines
    duration silence{20'000};            // ends a damaged answer; longer than the delays of a USB adapter
    local_echo echo = local_echo::off;   // automatic is off: a device may answer with the same text
};

enum class expect : std::uint8_t { message, nothing };

// Sends a message, as encode() gave it, and takes the next message that comes for the answer: this traffic has no
// addresses and no numbers, so an answer that comes after its timeout looks like that to the next question.
class exchange : public line_action {
public:
    exchange(message_framer& in, buffer message, expect answer, const exchange_options& options,
             time_point line_free_from, time_point now);

    action next(time_point now);
    void sent(time_point now);  // what next() said to send was handed to the driver
    void feed(time_point now, bytes received);
    void fault(time_point now, errc why);  // as message_framer::fault()

    // After done: the answer (empty when none is expected), or timed_out, incomplete (no end code came), collision,
    // line_not_quiet, or why the last attempt's answer was dropped.
    const result<buffer>& outcome() const { return outcome_; }
    unsigned attempts() const { return attempts_; }
    duration response_time() const { return response_time_; }  // to the end of the answer
    // Attempts to which nothing whole came, and the end of the first of them. Their answers may still come: give them
    // time before something else is asked.
    unsigned unanswered() const { return unanswered_; }
    time_point unanswered_since() const { return unanswered_since_; }
    time_point line_free_from() const { return line_free_from_; }

    // What else came, in its order: messages that nobody asked for, and losses. Theirs is the way of all messages.
    std::vector<result<buffer>> take_others() { return std::exchange(others_, {}); }

private:
    enum class state : std::uint8_t { wait_for_line, sending, wait_for_answer, finished };

    action wait_for_line(time_point now);
    action wait_for_answer(time_point now);
    void collect(time_point now);
    bytes without_echo(bytes received);
    bool collided() const { return failure_ == errc::collision; }
    time_point give_up_at() const;
    void fail_attempt(time_point now);
    void finish(result<buffer> outcome);

    message_framer& in_;
    buffer message_;
    expect expected_;
    exchange_options options_;
    state state_ = state::wait_for_line;
    time_point line_free_from_;
    time_point send_at_;
    time_point line_timeout_;
    time_point sent_until_{};
    std::optional<time_point> heard_;  // since sending, the echo apart
    std::size_t echoed_ = 0;           // bytes of our own message that came back
    std::optional<errc> failure_;      // of this attempt
    unsigned attempts_ = 0;
    unsigned unanswered_ = 0;
    time_point unanswered_since_{};
    duration response_time_{};
    std::vector<result<buffer>> others_;
    result<buffer> outcome_ = make_error_code(errc::timed_out);
};

// Waits for one message. What the framer holds beyond it, the next one gets.
class listener : public line_action {
public:
    listener(message_framer& in, time_point until) : in_(in), until_(until) {}

    action next(time_point now);
    void feed(time_point now, bytes received) { in_.feed(now, received); }
    void fault(time_point now, errc why) { in_.fault(now, why); }

    // After done: a message, why bytes were dropped, or timed_out at `until`.
    const result<buffer>& outcome() const { return outcome_; }

private:
    message_framer& in_;
    time_point until_;
    bool finished_ = false;
    result<buffer> outcome_ = make_error_code(errc::timed_out);
};

}  // namespace plcgw::general_purpose
