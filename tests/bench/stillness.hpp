// Whether the machine itself stood still while something was measured: then the figures are not the gateway's.
#pragma once

#include "tests/bench/wire_format.hpp"

#include <nlohmann/json_fwd.hpp>

namespace plcgw::bench {

class stillness {
public:
    // The emulator was to do something at the deadline, and came so late to it.
    void note_late(nanoseconds lateness);

    // A byte took so long through a pty, of which there is a sample every few milliseconds.
    void note_hop(nanoseconds took) { hops_.push_back(took); }

    void begin(nanoseconds now);  // a new window
    nlohmann::json report(nanoseconds now) const;

private:
    nanoseconds since_ = 0;
    std::uint64_t stolen_before_ = 0;
    std::uint64_t wakes_ = 0;
    nanoseconds late_ = 0;   // all of it
    nanoseconds still_ = 0;  // only where it was more than a wake-up takes
    nanoseconds worst_ = 0;
    std::vector<nanoseconds> hops_;
};

}  // namespace plcgw::bench
