// The special devices of the client of one channel: FX3 manual 6.1, 6.3 and 12.6, LS manual 4-1, 4-3 and 9-6. What
// power-on and STOP to RUN clear is the simulated PLC's business, but for the operation error M8067.
#pragma once

#include "bridge/plc/adprw_operands.hpp"
#include "bridge/plc/adprw_outcome.hpp"
#include "bridge/plc/simulated_plc.hpp"
#include "bridge/services/comm_counters.hpp"
#include "protocols/modbus/answer_fault.hpp"

namespace plcgw::plc {

struct adprw_error {
    modbus_error code{};
    std::uint8_t high{};  // of the details in D8403
    std::uint8_t low{};
};

// D8402 of an LS: 2xxyy, 3xxyy, 4xxyy and 218x hold the details, of numbers above 99 the last two digits. It has no 201
// and no 208: these are a station that does not answer (211) and a malformed answer (207).
modbus_error ls_error(const adprw_error& e);

class adprw_status {
public:
    adprw_status(simulated_plc& plc, const channel& of);

    void started(std::uint16_t step);  // clears what "next MODBUS command" clears
    void retrying(unsigned retry);     // 1 = first retry
    void completed();
    void failed(const adprw_error& e, std::uint16_t step);
    void refused_in_server(std::uint16_t step);                    // 217
    void refused(const operand_fault& fault, std::uint16_t step);  // 218

    // The client's counters (6.4), shown where D8415 and D8416 say. Only answers reach it: what others say on the line
    // while nobody was asked is not counted.
    void count_answer(const modbus::response& answer);
    void count_fault(const modbus::answer_fault& fault);

    void program_started();  // STOP to RUN: clears M8067 and the counters
    void program_stopped();  // nothing is in process any more

    bool is_server() const;                             // D8401 b4; LS: D8400 says MODBUS and not master
    std::uint16_t setting(std::uint32_t number) const;  // a D register; 0 where there is none

private:
    void clear_command();
    void count(counter which);
    void show(const adprw_error& e, std::uint16_t step);

    simulated_plc* plc_;
    const channel* channel_;
    comm_counters counters_;
    bool ls_;
};

}  // namespace plcgw::plc
