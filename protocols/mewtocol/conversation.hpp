// One question of a MEWTOCOL-COM client and the frames that belong to it, without time: on serial lines and on TCP. FP7
// serial communication manual 11.2.
#pragma once

#include "protocols/mewtocol/frame.hpp"
#include "protocols/mewtocol/line_framer.hpp"
#include "protocols/mewtocol/response.hpp"
#include "protocols/mewtocol/verdict.hpp"

namespace plcgw::mewtocol {

class conversation {
public:
    using answer_type = response;
    using unanswered = no_response;

    conversation(header head, station_id station, command question);

    // Whether the question fits into its fields and one frame. If not, it must not be sent.
    bool is_expressible() const;
    bool expects_answer() const { return mewtocol::expects_answer(station_, question_); }
    // MC and MD are not: done twice, the second is refused although the first was executed.
    bool is_repeatable() const;

    buffer begin();  // the question; once more for each further attempt
    verdict<response> hear(const reception& r);

    // What the station must be told before it takes another command: AB, while more frames of an answer wait there.
    std::optional<buffer> abort() const;

    std::size_t max_answer_size() const { return max_frame_size(head_); }  // of one frame
    bool echo_seen() const { return echo_seen_; }

private:
    buffer send(frame f);
    verdict<response> hear_text(const frame& f);

    header head_;
    station_id station_;
    command question_;
    std::string sent_;    // last, without CR: what an echo looks like
    std::string text_;    // of the answer so far
    bool split_ = false;  // text_ waits for more
    bool refused_ = false;
    bool echo_seen_ = false;
};

}  // namespace plcgw::mewtocol
