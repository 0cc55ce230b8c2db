#include "tests/field/press.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plcgw::field {

namespace {

constexpr double most_strokes_per_minute = 60;  // more is a fault, and stops it

std::uint16_t word(double value) { return static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, 65535.0)); }

// It works in the lower third of the way down; each sheet is a little different.
double force(double angle, std::uint32_t stroke)
{
    if (angle < 0.35 || angle > 0.5)
        return 0;
    const double sheet = 250 + 10 * std::sin(stroke * 0.7);
    return sheet * std::sin((angle - 0.35) / 0.15 * std::numbers::pi);
}

}  // namespace

press::press(fp7_memory& memory) : memory_(memory)
{
    memory_.word(fp7_area::dt, 10) = 30;
    memory_.set_contact(fp7_area::r, 1, 0, true);  // R10
    memory_.set_contact(fp7_area::x, 0, 0, true);  // the guard is closed
}

void press::advance(double seconds)
{
    seconds = std::min(seconds, 60.0);  // somebody had stopped this program
    const double setpoint = memory_.word(fp7_area::dt, 10);
    const bool fault = setpoint > most_strokes_per_minute;
    const bool start = memory_.contact(fp7_area::r, 1, 0);
    // Without start it goes on to the upper dead centre; a fault stops it where it is.
    const double strokes_per_minute = fault || (!start && angle_ == 0) ? 0 : setpoint;

    // Short steps, or the force would be missed when the computer was busy for a while.
    const int steps = 1 + static_cast<int>(seconds / 0.01);
    for (int i = 0; i < steps && strokes_per_minute > 0; ++i) {
        angle_ += strokes_per_minute / 60 * seconds / steps;
        since_top_s_ += seconds / steps;
        stroke_peak_kn_ = std::max(stroke_peak_kn_, force(angle_, strokes_));
        if (stroke_peak_kn_ > 0)
            peak_kn_ = stroke_peak_kn_;
        if (angle_ < 1)
            continue;
        ++strokes_;
        cycle_s_ = std::exchange(since_top_s_, 0);
        stroke_peak_kn_ = 0;
        angle_ -= 1;
        if (start)
            continue;
        angle_ = 0;
        break;
    }
    const double load = strokes_per_minute / most_strokes_per_minute;
    oil_celsius_ += (25 + 40 * load - oil_celsius_) * (1 - std::exp(-seconds / 60));
    memory_.set_contact(fp7_area::r, 0, 2, fault);
    show(strokes_per_minute);
}

void press::show(double strokes_per_minute)
{
    const std::uint16_t values[] = {static_cast<std::uint16_t>(strokes_),
                                    static_cast<std::uint16_t>(strokes_ >> 16),
                                    word(cycle_s_ * 100),
                                    word(force(angle_, strokes_) * 10),
                                    word(peak_kn_ * 10),
                                    word(oil_celsius_ * 10)};
    for (std::size_t i = 0; i < std::size(values); ++i)
        memory_.word(fp7_area::dt, 100 + i) = values[i];
    memory_.set_contact(fp7_area::r, 0, 0, strokes_per_minute > 0);
    memory_.set_contact(fp7_area::r, 0, 1, angle_ == 0);
    memory_.set_contact(fp7_area::y, 0, 0, strokes_per_minute > 0);
}

}  // namespace plcgw::field
