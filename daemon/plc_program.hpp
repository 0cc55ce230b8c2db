// Runs the ADPRW instructions of a PLC's program on a line.
#pragma once

#include "bridge/plc/adprw_runner.hpp"
#include "daemon/answer_gate.hpp"
#include "daemon/forward_gate.hpp"

#include <boost/asio/io_context.hpp>

#include <functional>

namespace plcgw {

class plc_program {
public:
    // timing: of the line; what the PLC's D8409-D8412 say goes before it. settle: called when devices changed.
    plc_program(asio::io_context& loop, plc::adprw_runner runner, forward_gate& line,
                const modbus::serial_options& timing, std::function<void()> settle);

    void obey(const line_voice& voice) { gate_.obey(voice); }  // of a pair: the standby's program rests
    asio::awaitable<void> run();                               // until the io_context ends
    void look();                                               // devices changed: a contact may have closed

private:
    asio::awaitable<void> ask(plc::adprw_question question);

    plc::adprw_runner runner_;
    forward_gate& line_;
    modbus::serial_options timing_;
    std::function<void()> settle_;
    asio::steady_timer pause_;
    answer_gate gate_;
};

}  // namespace plcgw
