// What others say on a MEWTOCOL line on which we are a client, too, but silent. FP7 serial communication manual 11.2
// and 11.3: `#` marks a command, `$` and `!` its response.
//
// Of MEWTOCOL-COM, commands and their responses, also those in several frames. Of MEWTOCOL7-COM only that somebody
// asked: its responses mean something to whoever knows the dialect of the station.
#pragma once

#include "protocols/mewtocol/conversation.hpp"

#include <deque>

namespace plcgw::mewtocol {

struct heard_exchange {
    station_id station{};
    command asked;
    std::optional<response> answer;  // nothing: silence, or nothing that fits. no_response: none was to come
    time_point ended{};              // the answer's CR; of silence, when it was clear
};

class bus_listener {
public:
    // max_silence: in the middle of a frame.
    bus_listener(duration response_timeout, duration max_silence)
        : response_timeout_(response_timeout), in_(max_silence)
    {
    }

    void feed(time_point now, bytes received)
    {
        heard_at_ = now;
        in_.feed(now, received);
    }

    // We ourselves asked this: it is no foreign question, nor are its echo and its answer.
    void spoke(time_point now, bytes frame);

    // Exchanges of others; to be asked after feed() and at the deadline.
    std::optional<heard_exchange> next(time_point now);
    time_point deadline() const;  // time_point::max(): none

    // The CR of the last whole command that was not ours.
    std::optional<time_point> foreign_question() const { return foreign_; }

private:
    struct question {
        conversation with;
        station_id station{};
        command asked;
        bool ours = false;
    };

    void take(const reception& r);
    void take_question(const frame& f, const reception& r);
    bool is_ours(const reception& r);
    void note(bool ours);
    void tell(std::optional<response> answer, time_point at);
    time_point silence_is_clear_at() const { return heard_at_ + response_timeout_; }

    duration response_timeout_;
    line_framer in_;
    time_point heard_at_{};
    std::optional<question> asked_;
    std::string spoken_;   // our last command, without CR
    unsigned echoes_ = 0;  // times that it may still be heard
    std::optional<time_point> foreign_;
    std::deque<heard_exchange> heard_;
};

}  // namespace plcgw::mewtocol
