// How long one question keeps a bus busy: request, turnaround, response, and the silence behind it.
#pragma once

#include "bridge/routes/station_question.hpp"
#include "protocols/serial_timing.hpp"

namespace plcgw {

// Until a device answers, if nobody has measured it.
inline constexpr duration default_turnaround{5'000};

enum class bus_protocol : std::uint8_t { modbus_rtu, modbus_ascii, modbus_tcp, mewtocol_com, mewtocol7_com };

struct bus_timing {
    bus_protocol protocol = bus_protocol::modbus_rtu;
    character_format format{};                 // of a serial line, also one behind a device server
    duration gap{};                            // silence before a request, if longer than the protocol's
    duration turnaround = default_turnaround;  // from the end of a request to the first byte of the answer
    unsigned at_a_time = 1;                    // MODBUS TCP: requests under way
    mewtocol::headers headers = mewtocol::headers::automatic;
    mewtocol7::dialect dialect{};
};

// From the first bit of the request to the first of the next one, retries and faults aside. MODBUS over Serial Line
// V1.02 section 2.5.1.1; on a network a byte counts as 1 us. 0 for what cannot be asked.
duration exchange_time(const bus_timing& bus, const station_question& asked);

// What of the time from the end of a request to the end of its answer the device took, on serial lines. Of a question
// that is_one_exchange().
duration turnaround_in(const bus_timing& bus, const station_question& asked, duration until_answered);

// One request, one answer: what is read so belongs to one moment. False for what cannot be asked.
bool is_one_exchange(const bus_timing& bus, const station_question& asked);

}  // namespace plcgw
