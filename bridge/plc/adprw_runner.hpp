// Runs the ADPRW instructions of one PLC on one channel, one at a time (FX3 manual 10.4): which question its line asks
// next, and what the answer does to the devices.
#pragma once

#include "bridge/plc/adprw_command.hpp"
#include "bridge/plc/adprw_status.hpp"
#include "protocols/time.hpp"

namespace plcgw::plc {

// D8406 and D8409 to D8412, as they are when the instruction begins. An invalid time is the nearest valid one.
struct adprw_timing {
    duration response_timeout{3'000'000};
    duration turnaround{400'000};  // after a broadcast
    duration message_delay{};      // before a request; at least 3.5 characters, 0 stands for these
    unsigned retries = 0;
    std::uint8_t delimiter = 0x0A;  // D8406: the second end character of ASCII
    bool operator==(const adprw_timing&) const = default;
};

struct adprw_question {
    modbus::unit_id unit{};  // 0 = broadcast: nobody answers, nor does anybody to "force listen only"
    modbus::request request;
    adprw_timing timing;
    std::uint16_t step{};

    std::uint64_t number{};  // the answer to a question that the PLC has forgotten is passed over
    std::optional<place> target;
    std::size_t instruction{};
};

class adprw_runner {
public:
    // Throws std::out_of_range when the PLC has no such channel.
    adprw_runner(adprw_program program, simulated_plc& plc, unsigned channel);

    // Looks at the contacts, and at the PLC's switch: to be called when devices changed or the PLC was stopped, started
    // or powered on, so that no edge is missed while the line is busy.
    void scan();

    // The next instruction whose contact wants it, after the one before in the order of the program. Nothing while a
    // question is out. Instructions that the PLC refuses (errors 217 and 218) are passed over, with their flags.
    std::optional<adprw_question> next(time_point now);
    time_point wake_at(time_point now) const;  // when next() has something to do, if no device changes before

    // Nothing or no answer that fits came to one attempt; each of them is told before finished(). The next attempt
    // begins at once, if there are retries left.
    void attempt_failed(const adprw_question& q, const modbus::answer_fault& why);
    void finished(const adprw_question& q, const adprw_outcome& outcome, time_point now);

    bool is_out(const adprw_question& q) const { return asked_ == q.number; }
    const adprw_program& program() const { return program_; }

private:
    struct state {
        bool contact = false;     // when it was last looked at
        bool pending = false;     // an edge came that was not served
        time_point not_before{};  // wakes nobody before
    };

    void follow_switch();
    bool closed(const contact& of) const;
    bool is_due(std::size_t index) const;
    void run_move(const mov& of);
    std::optional<adprw_question> ask(std::size_t index, time_point now);
    adprw_timing timing() const;

    adprw_program program_;
    simulated_plc* plc_;
    const channel* channel_;
    adprw_status status_;
    std::vector<state> states_;  // of the instructions
    std::size_t position_ = 0;   // where the next search begins
    unsigned starts_ = 0;        // of the PLC, as last seen
    bool first_scan_ = true;     // M8002
    std::uint64_t questions_ = 0;
    std::optional<std::uint64_t> asked_;
    unsigned failed_attempts_ = 0;  // of the question that is out
};

}  // namespace plcgw::plc
