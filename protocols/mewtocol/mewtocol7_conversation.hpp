// One question of a MEWTOCOL7-COM client and the frames that belong to it, without time. Frame numbers tell late
// answers from the right one. FP7 serial communication manual 11.3.
#pragma once

#include "protocols/mewtocol/line_framer.hpp"
#include "protocols/mewtocol/mewtocol7_message.hpp"
#include "protocols/mewtocol/verdict.hpp"

namespace plcgw::mewtocol7 {

class conversation {
public:
    using answer_type = response;
    using unanswered = no_response;

    // number: of its first frame; the conversation after it begins with next_number().
    conversation(station_id station, command question, std::uint8_t number, dialect d = {});

    bool is_expressible() const;
    bool expects_answer() const { return true; }
    bool is_repeatable() const { return true; }

    buffer begin();  // the question; once more for each further attempt, with the next number
    mewtocol::verdict<response> hear(const mewtocol::reception& r);
    std::optional<buffer> abort() const { return std::nullopt; }  // a new command takes its place

    std::size_t max_answer_size() const { return max_frame_size; }
    bool echo_seen() const { return echo_seen_; }
    std::uint8_t next_number() const { return number_; }

private:
    buffer send(frame f);
    mewtocol::verdict<response> hear_text(const frame& f);

    station_id station_;
    command question_;
    dialect dialect_;
    std::uint8_t number_;     // of the frame to be sent next
    std::uint8_t awaited_{};  // of the frame that was sent last
    std::string sent_;        // last, without CR: what an echo looks like
    std::string text_;        // of the answer so far
    bool split_ = false;
    bool echo_seen_ = false;
};

}  // namespace plcgw::mewtocol7
