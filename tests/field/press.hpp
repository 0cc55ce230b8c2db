// What the simulated FP7 controls: an eccentric press. tests/field/README.md lists its devices.
#pragma once

#include "tests/field/fp7_memory.hpp"

namespace plcgw::field {

class press {
public:
    explicit press(fp7_memory& memory);
    void advance(double seconds);

private:
    void show(double strokes_per_minute);

    fp7_memory& memory_;
    std::uint32_t strokes_ = 1'000'000;  // more than one word, so that a wrong word order shows
    double angle_ = 0;                   // of the crank, in turns: 0 is the upper dead centre
    double since_top_s_ = 0;
    double cycle_s_ = 0;         // of the last stroke
    double stroke_peak_kn_ = 0;  // of this stroke, so far
    double peak_kn_ = 0;         // of this or the last stroke that pressed something
    double oil_celsius_ = 25;
};

}  // namespace plcgw::field
