// One question to one station of a serial line, RTU or ASCII, with its retries, as a state machine: whoever drives the
// line does what next() says. MODBUS over Serial Line V1.02 section 2.4.1 (client state diagram); FX3 manual 6.1
// D8409-D8412.
#pragma once

#include "protocols/modbus/ascii.hpp"
#include "protocols/modbus/framing.hpp"
#include "protocols/modbus/rtu.hpp"
#include "protocols/serial_timing.hpp"

#include <variant>

namespace plcgw::modbus {

struct serial_options {
    character_format format;
    duration response_timeout{500'000};  // from the last byte of the request to the first of the answer
    unsigned retries = 1;                // after the first attempt
    duration turnaround{100'000};        // silence after a broadcast
    duration gap{};                      // silence before a request; at least 3.5 characters
    duration silence{20'000};            // ends a damaged answer; longer than the delays of a USB adapter
    local_echo echo = local_echo::automatic;
    framing mode = framing::rtu;
    std::uint8_t delimiter = ascii_delimiter;  // of the station that is asked
};

class serial_transaction {
public:
    struct send {
        bytes adu;  // valid until the next call of next()
    };
    struct wait {
        time_point until;  // or until bytes come
    };
    struct done {};
    using action = std::variant<send, wait, done>;

    // line_free_from: when the line will have been silent for long enough, as the transaction before said.
    serial_transaction(unit_id unit, request question, const serial_options& timing, time_point line_free_from,
                       time_point now);
    serial_transaction(const serial_transaction&) = delete;  // the answer points to the question
    serial_transaction& operator=(const serial_transaction&) = delete;

    action next(time_point now);
    void sent(time_point now);  // what next() said to send was handed to the driver
    void feed(time_point now, bytes received);

    // After done:
    const result<response>& outcome() const { return outcome_; }
    unsigned attempts() const { return attempts_; }
    duration response_time() const { return response_time_; }  // of the attempt that was answered
    // Attempts to which no answer came, and the end of the first of them. Their answers may still come.
    unsigned unanswered() const { return unanswered_; }
    time_point unanswered_since() const { return unanswered_since_; }
    const std::vector<answer_fault>& faults() const { return faults_; }  // of each attempt that failed
    std::size_t stray_bytes() const { return stray_bytes_; }             // heard while nobody was asked
    bool echo_seen() const { return echo_seen_; }
    time_point line_free_from() const { return line_free_from_; }

private:
    enum class state { wait_for_line, sending, wait_for_answer, wait_for_silence, finished };

    void expect_answer();
    void fail_attempt(time_point now, answer_fault why);
    void finish(result<response> outcome);
    void answered(time_point now, response answer);
    duration gap() const;
    bytes without_echo(bytes received);
    time_point silence_ends() const;

    unit_id unit_;
    request question_;
    serial_options timing_;
    buffer adu_;
    std::optional<std::variant<rtu_answer, ascii_answer>> answer_;
    std::vector<answer_fault> faults_;
    state state_ = state::wait_for_line;
    time_point line_free_from_;
    time_point give_up_;       // when a line that never falls silent is reported
    time_point sent_until_{};  // end of the last byte of the last request on the wire
    unsigned unanswered_ = 0;
    time_point unanswered_since_{};
    time_point heard_{};  // last byte received
    unsigned attempts_ = 0;
    std::size_t stray_bytes_ = 0;
    buffer echo_;  // bytes since the request that may be its echo
    bool awaits_echo_ = false;
    bool echo_seen_ = false;
    duration response_time_{};
    result<response> outcome_ = make_error_code(errc::timed_out);
};

}  // namespace plcgw::modbus
