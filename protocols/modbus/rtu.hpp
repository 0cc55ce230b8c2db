// RTU framing, MODBUS over Serial Line V1.02 section 2.5.1: unit, PDU, CRC.
#pragma once

#include "protocols/modbus/answer_fault.hpp"

namespace plcgw::modbus {

inline constexpr std::size_t rtu_overhead = 3;  // unit id before, CRC behind the PDU
inline constexpr std::size_t max_rtu_size = max_pdu_size + rtu_overhead;

buffer encode_rtu(const frame& f);

// Collects what a line brings after a request and finds the answer in it. Length ends a whole answer at once. Noise
// before it, such as the 00 or FF of a transceiver that turns round, is skipped: unit, function, length and CRC must
// all fit.
class rtu_answer {
public:
    rtu_answer(unit_id unit, const request& question);

    // The answer if it is whole now. Call again with more bytes otherwise.
    std::optional<response> feed(bytes received);

    bool empty() const { return received_.empty(); }

    // Whether our station's answer has begun somewhere in the bytes so far. If not, they were noise or a stranger's.
    bool begun() const;

    // Whether what began may be all of an answer, although damaged: then no other one is on its way.
    bool whole() const;

    // Why there was no answer in the bytes so far, to be asked when the line fell silent.
    answer_fault fault() const;

private:
    errc failure() const;
    std::optional<response> answer_at(std::size_t start) const;

    unit_id unit_;
    const request* question_;
    std::uint8_t function_;
    buffer received_;
};

}  // namespace plcgw::modbus
