// One line as a member of a pair sees it: whether somebody else speaks there, and whether this member may.
#pragma once

#include "bridge/standby/line_voice.hpp"
#include "bridge/standby/pair_beat.hpp"

#include <string>

namespace plcgw {

struct pair_line_settings {
    std::string name;
    duration quiet{};    // a member that works on the line is not silent for longer than half of this
    duration limit{};    // so long without a byte, and whoever ought to speak there cannot
    bool polled = true;  // something is asked regularly: silence says something
};

// How sure this member is that nobody else asks.
enum class certainty : std::uint8_t {
    agreed,   // the other member says so, or has left
    guessed,  // nothing is known of it: listen before talking
};

class pair_line {
public:
    explicit pair_line(pair_line_settings settings) : settings_(std::move(settings)) {}

    const pair_line_settings& settings() const { return settings_; }
    void heard(const line_heard& what);
    void listen_anew(time_point now);  // nothing is known of what was before

    // Nobody is in the middle of something: a question heard was answered, or is too old for that.
    bool is_free(time_point now) const;
    // extra: so that two who know nothing of each other do not begin at the same moment.
    bool is_quiet(time_point now, duration extra = {}) const
    {
        return !can_hear() || silent_for(now) >= settings_.quiet + extra;
    }
    bool is_silent(time_point now, duration extra = {}) const
    {
        return can_hear() && settings_.polled && silent_for(now) >= settings_.limit + extra;
    }
    bool can_hear() const { return heard_.listens && heard_.port_open; }
    line_report report(time_point now) const;
    std::optional<duration> asked(time_point now) const;

    // The other one asked so long ago, and that was not heard here.
    bool missed(time_point now, duration asked_ago) const;

    bool speaks() const { return speaks_; }
    void begin(time_point now);
    void stop(time_point now);
    void hold_back(time_point now);  // somebody else speaks: until the line has been silent for its limit
    bool is_held_back() const { return held_back_; }
    bool heard_others() const;  // since this member speaks there
    bool is_worth_a_claim() const { return !tried_ && heard_.port_open; }

    // At each look, before begin(). On a line without any sign of life, and a member that may be there unheard (its
    // cable may be plugged in again just now), it speaks for a moment between times of listening.
    void look(time_point now, certainty how, duration moment);
    time_point speaks_until(time_point lease_until) const;

private:
    duration silent_for(time_point now) const;

    pair_line_settings settings_;
    line_heard heard_{};
    bool speaks_ = false;
    bool held_back_ = false;
    bool tried_ = false;  // spoke here, and nothing was heard since it stopped
    time_point since_{};  // speaks, or is held back
    time_point stopped_{};
    time_point listens_since_{};
    certainty how_ = certainty::guessed;
    time_point moment_ends_ = time_point::max();
    time_point next_moment_{};
};

}  // namespace plcgw
