// Cuts the frames of MEWTOCOL-COM and MEWTOCOL7-COM out of received bytes: a header begins one, CR ends it. FP7 serial
// communication manual 11.2.1 and 11.3.1. The header tells the two apart, so one framer serves a port that speaks both.
//
// The header characters and CR are never part of a text. So a header in the middle begins a new frame, and whatever
// stands in front of a header is noise; a LF behind CR, which some computers send, is ignored.
#pragma once

#include "protocols/framer.hpp"

#include <deque>
#include <string>

namespace plcgw::mewtocol {

struct reception {
    std::string characters;  // a frame from its header to the last character in front of CR; overlong: its beginning
    errc why{};          // 0: a frame. overlong: it ended with CR. restarted, incomplete, bad_header (noise): dropped
    std::size_t size{};  // characters on the wire
    bool operator==(const reception&) const = default;
};

constexpr bool is_frame(const reception& r) { return r.why == errc{}; }

class line_framer {
public:
    using frame_type = reception;

    // max_silence: in the middle of a frame; no gap between characters is defined, so it may be long.
    explicit line_framer(duration max_silence) : max_silence_(max_silence) {}

    void feed(time_point now, bytes received);
    std::optional<reception> next(time_point now);
    time_point deadline() const;

    bool in_frame() const { return state_ == state::frame; }  // a header came, its CR has not

private:
    enum class state : std::uint8_t { idle, noise, frame };

    void take(char c);
    void drop(errc why);
    void report(errc why);

    duration max_silence_;
    state state_ = state::idle;
    std::string characters_;
    std::size_t size_ = 0;
    time_point heard_{};
    std::deque<reception> events_;
};

static_assert(framer<line_framer>);

}  // namespace plcgw::mewtocol
