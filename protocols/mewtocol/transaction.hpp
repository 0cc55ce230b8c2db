// One question to one station of a serial line, with its retries and the frames of its answer, as a state machine:
// whoever drives the line does what next() says. FP7 serial communication manual 1.2.2 and 7.3; KT4R communication
// manual 4 (timing). The same for MEWTOCOL-COM and MEWTOCOL7-COM.
#pragma once

#include "protocols/mewtocol/line_framer.hpp"
#include "protocols/mewtocol/verdict.hpp"
#include "protocols/serial_timing.hpp"

#include <variant>

namespace plcgw::mewtocol {

struct line_options {
    character_format format{.baud_rate = 9600, .data_bits = 8, .check = parity::odd, .stop_bits = 1};  // 7.1.1
    duration response_timeout{500'000};  // from the last byte of a request to the first of the answer, for each frame
    unsigned retries = 2;                // after the first attempt
    duration turnaround{100'000};        // silence after what nobody answers (a global command, AB), or before a busy
                                         // station is asked again
    duration gap{};                      // silence before a request; at least one character
    duration silence{100'000};           // ends an answer that lost its CR
};

template <class Conversation>
class transaction {
public:
    using answer_type = typename Conversation::answer_type;

    struct send {
        bytes adu;  // valid until the next call of next()
    };
    struct wait {
        time_point until;  // or until bytes come
    };
    struct done {};
    using action = std::variant<send, wait, done>;

    // line_free_from: when the line will have been silent for long enough, as the transaction before said. A question
    // that is not expressible is not sent: errc::not_expressible.
    transaction(Conversation question, const line_options& timing, time_point line_free_from, time_point now);

    action next(time_point now);
    void sent(time_point now);  // what next() said to send was handed to the driver
    void feed(time_point now, bytes received);

    // After done:
    const result<answer_type>& outcome() const { return outcome_; }
    unsigned attempts() const { return attempts_; }
    duration response_time() const { return response_time_; }  // to the first frame of the attempt that was answered
    // Attempts to which no answer came, and the end of the first of them. Their answers may still come.
    unsigned unanswered() const { return unanswered_; }
    time_point unanswered_since() const { return unanswered_since_; }
    const std::vector<errc>& faults() const { return faults_; }  // of each attempt that failed
    std::size_t stray_bytes() const { return stray_bytes_; }     // heard while nobody was asked
    bool echo_seen() const { return conversation_.echo_seen(); }
    time_point line_free_from() const { return line_free_from_; }
    const Conversation& conversation() const { return conversation_; }

private:
    enum class state : std::uint8_t { wait_for_line, sending, wait_for_answer, finished };
    enum class message : std::uint8_t { question, next_frame, abort };

    void queue(message what, buffer adu, time_point now);
    void judge(time_point now, const reception& r);
    void fail_attempt(time_point now, errc why, bool came);
    void ask_again(time_point now, answer_type refusal);
    void conclude(time_point now, result<answer_type> outcome);
    duration gap() const;
    time_point give_up_waiting() const;

    Conversation conversation_;
    line_options timing_;
    line_framer framer_;
    buffer adu_;
    message what_ = message::question;
    state state_ = state::wait_for_line;
    bool concluded_ = false;  // only AB is still to be sent
    time_point line_free_from_;
    time_point give_up_;  // when a line that never falls silent is reported
    time_point sent_until_{};
    time_point heard_{};
    errc heard_instead_ = errc::timed_out;  // what came while the answer did not
    unsigned attempts_ = 0;
    unsigned allowed_;      // attempts
    bool cleared_ = false;  // AB was sent because the station refused
    unsigned unanswered_ = 0;
    time_point unanswered_since_{};
    std::vector<errc> faults_;
    std::size_t stray_bytes_ = 0;
    duration response_time_{};
    result<answer_type> outcome_ = make_error_code(errc::timed_out);
};

}  // namespace plcgw::mewtocol
