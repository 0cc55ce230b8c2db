// Whether this member of a pair may ask on a client line, and what it hears there. The pair's controller says the
// first, the line's driver the second. A line without a pair has no line_voice: it always speaks.
#pragma once

#include "protocols/time.hpp"

#include <optional>

namespace plcgw {

enum class voice : std::uint8_t {
    silent,    // only listens
    speaking,  // asks
};

// What the driver of a line knows of its wire.
struct line_heard {
    std::optional<time_point> foreign_request;  // the end of the last whole question that was not ours
    std::optional<time_point> anything;         // the last byte received, whosever it was
    std::optional<time_point> asked;            // our own last question
    bool port_open = false;
    time_point open_since{};  // of a port that is open: before that nothing could be heard
    bool listens = false;     // others can be heard: a serial port of this machine. Silence on TCP says nothing
};

class line_voice {
public:
    // The controller's. A permission ends by itself unless it is renewed: whoever stood still (SIGSTOP, a machine
    // without time for us) is silent when it goes on, until the controller has looked around.
    void speak_until(time_point end) { until_ = end; }
    void be_silent() { until_ = time_point::min(); }

    // The driver's, with the time of now and not of before: asked before each question goes out, each repetition, each
    // forwarded request and each write.
    bool may_speak(time_point now) const { return now < until_; }
    voice state(time_point now) const { return may_speak(now) ? voice::speaking : voice::silent; }

    line_heard heard{};

private:
    time_point until_ = time_point::min();
};

}  // namespace plcgw
