// What others say on a line on which we are a client, too, but silent: which station was asked what, and what it said.
// RTU and ASCII, MODBUS over Serial Line V1.02 section 2.
//
// Where a request ends and its answer begins is rtu_bus_framer's business; of ASCII, each frame is the answer that the
// last question waits for, or else a request. What neither tells: writes of one item are answered by their own bytes,
// and so a repetition looks like the answer. The answer comes within the response timeout, and the repetition behind
// it.
#pragma once

#include "protocols/modbus/bus_framer.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <deque>
#include <map>

namespace plcgw::modbus {

struct heard_exchange {
    unit_id unit{};
    request asked;
    std::optional<response> answer;  // nothing: silence, or nothing that fits. no_response: none was to come
    time_point ended{};              // the answer's last byte; of silence, when it was clear
};

class bus_listener {
public:
    // Of the timing: mode, format, silence and response timeout.
    explicit bus_listener(const serial_options& timing);

    // For stations that others wait for longer or shorter.
    void set_timeout(unit_id unit, duration timeout) { timeouts_[unit] = timeout; }

    void feed(time_point now, bytes received);

    // We ourselves asked this: it is no foreign question, nor are its echo and its answer.
    void spoke(time_point now, bytes adu);

    // Exchanges of others, in their order; nothing more when there is nothing. To be asked after feed() and at the
    // deadline.
    std::optional<heard_exchange> next(time_point now);
    time_point deadline() const;  // time_point::max(): none

    // The last byte of the last whole request that was not ours.
    std::optional<time_point> foreign_question() const { return foreign_; }

private:
    struct question {
        unit_id unit{};
        std::optional<request> asked;  // nothing: of an unknown function
        buffer pdu;
        time_point ended{};
        bool ours = false;
    };

    void take(const bus_event& event, time_point at);
    void take_question(const frame& f, time_point at);
    bool take_answer(const frame& f, time_point at);
    bool is_repetition(const frame& f, time_point at) const;
    bool is_ours(const frame& f);
    void give_up(time_point at);
    time_point silence_is_clear_at() const;
    time_point time_of(const bus_event& event);

    serial_options timing_;
    std::map<unit_id, duration> timeouts_;
    bus_framer in_;
    std::optional<question> asked_;
    std::optional<question> given_up_;  // the last one: it may be repeated, or answered late
    buffer spoken_;                     // our last request
    unsigned echoes_ = 0;               // times that it may still be heard
    std::optional<time_point> foreign_;
    std::deque<std::pair<std::size_t, time_point>> came_;  // of RTU: up to which byte, and when
    std::size_t fed_ = 0;
    std::size_t used_ = 0;
    std::deque<heard_exchange> heard_;
};

}  // namespace plcgw::modbus
