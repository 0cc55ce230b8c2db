// The diagnostic counters of a serial server: FX3 manual 6.4, V1.1b3 section 6.8, Serial Line V1.02 appendix A.
#pragma once

#include "protocols/modbus/types.hpp"

#include <array>

namespace plcgw {

enum class counter : std::uint8_t {
    bus_message,  // whole frames on the line, whoever sent them
    bus_communication_error,
    exception_error,     // also when a broadcast let no exception be sent
    server_message,      // to this station, broadcasts included
    server_no_response,  // broadcasts
    server_nak,          // always 0 (6.4)
    server_busy,         // always 0
    character_overrun,
    event,  // requests carried out
};

class comm_counters {
public:
    // All of them stop at FFFF. This manual says it of the event counter (7.12), Mitsubishi's manual of the MELSEC iQ-R
    // C24 of all; and one that went round to 0 would call a bad line a good one.
    void count(counter which)
    {
        std::uint16_t& value = values_[static_cast<std::size_t>(which)];
        value = static_cast<std::uint16_t>(value + (value == 0xFFFF ? 0 : 1));
    }

    std::uint16_t operator[](counter which) const { return values_[static_cast<std::size_t>(which)]; }

    void clear() { values_ = {}; }

    // As D100-D109 in 6.4; the tenth is not used.
    const std::array<std::uint16_t, 10>& registers() const { return values_; }

private:
    std::array<std::uint16_t, 10> values_{};
};

// Sub-functions 0B to 12 of diagnostics ask for the counters in their order.
constexpr counter counter_of(modbus::diagnostic what)
{
    return counter{static_cast<std::uint8_t>(static_cast<unsigned>(what) -
                                             static_cast<unsigned>(modbus::diagnostic::bus_message_count))};
}

static_assert(counter_of(modbus::diagnostic::bus_character_overrun_count) == counter::character_overrun);

}  // namespace plcgw
