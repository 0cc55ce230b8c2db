// Which member of a hot-standby pair is active, and on which lines it may ask: roles, terms, leases, listening before
// talking. Pure: beats, what the lines heard and the time go in, roles and permissions come out.
#pragma once

#include "bridge/standby/pair_beat.hpp"
#include "bridge/standby/pair_line.hpp"

#include <optional>
#include <span>
#include <utility>

namespace plcgw {

struct pair_settings {
    std::string member;
    unsigned priority = 50;
    bool hand_back = true;       // the member of higher priority gets the role back
    duration lease{};            // without a beat for this long a member is not active any more
    duration listen{};           // after the start, before anything else
    duration hand_back_after{};  // as standby, so that its memory is warm
    std::vector<pair_line_settings> lines{};
};

struct pair_event {
    enum class severity : std::uint8_t { info, warning } level{};
    std::string text;
};

class standby_pair {
public:
    standby_pair(pair_settings settings, time_point now);

    // The other member's beat came; its liveliness was lost. Before look(), in the order in which they came.
    void heard(time_point now, const pair_beat& beat);
    void lost();

    // Renews the own lease and decides, at least every beat_period(). Of each line, as numbered by the settings. After
    // a time longer than the lease this member is not active any more: it has stood still, and listens anew.
    void look(time_point now, std::span<const line_heard> lines);
    duration beat_period() const { return settings_.lease / 5; }

    // Until when this member may ask on a line if look() is not called again; in the past: it may not.
    time_point speaks_until(std::size_t line) const;

    pair_role role() const { return role_; }
    time_point lease_until() const { return lease_until_; }
    bool is_active(time_point now) const { return role_ == pair_role::active && now < lease_until_; }
    std::uint64_t term() const { return term_; }
    const std::string& why() const { return why_; }  // it has this role

    pair_beat beat() const;                                   // to be said now
    bool take_news() { return std::exchange(news_, false); }  // the beat has changed: say it at once
    std::vector<pair_event> take_events() { return std::exchange(events_, {}); }

    const std::optional<pair_beat>& other() const { return other_; }  // what was heard last
    bool other_lives() const;
    bool line_is_held_back(std::size_t line) const { return lines_[line].is_held_back(); }

    // The other member shall be active, or this one if it is not. Why that cannot be, or nothing.
    std::optional<std::string> switch_over(time_point now);
    void leave(time_point now);  // for good: the beat says it

private:
    struct claim {
        std::uint64_t term{};
        time_point since{};
        std::string why;
        bool keeps = false;
        bool when_nobody = false;  // is active: moot as soon as the other one is
    };
    enum class other_state : std::uint8_t { unknown, alive, lost, left };

    bool outranks(const pair_beat& beat) const;
    bool claim_outranks(const pair_beat& beat) const;
    void heard_as_active(time_point now, const pair_beat& beat);
    void heard_as_standby(const pair_beat& beat);
    void give_way(time_point now, const pair_beat& beat, const std::string& why);
    void listen_anew(time_point now, const std::string& why);
    void become(time_point now, pair_role role, const std::string& why);
    void begin_claim(time_point now, const std::string& why, bool keeps);
    void follow_claim(time_point now);
    void look_at_other(time_point now);
    void look_as_standby(time_point now);
    void take_over_if_quiet(time_point now);
    void take_silent_lines(time_point now);
    duration slot() const;  // extra silence before this member begins, where it knows of no other
    std::optional<std::string> reason_to_claim(time_point now) const;
    std::optional<std::string> silent_line(time_point now) const;
    void look_as_active(time_point now);
    void look_at_held_back(time_point now, pair_line& line, certainty how);
    unsigned good_lines_here(time_point now) const;
    unsigned good_lines_there() const;
    pair_line_report report_there(const std::string& line) const;
    void say(pair_event::severity level, std::string text) { events_.push_back({level, std::move(text)}); }

    pair_settings settings_;
    std::vector<pair_line> lines_;
    pair_role role_ = pair_role::starting;
    std::uint64_t term_ = 0;
    std::string why_;
    bool keeps_ = false;  // the role, though the other member would get it back: somebody wanted it so
    bool offers_ = false;
    bool leaving_ = false;
    time_point role_since_;
    time_point listens_until_;
    time_point lease_until_;
    std::optional<claim> claim_;
    std::optional<pair_beat> other_;
    other_state other_is_ = other_state::unknown;
    time_point other_heard_{};
    unsigned attempts_ = 0;  // that met another member
    bool busy_said_ = false;
    time_point offers_until_{};
    bool news_ = true;
    std::vector<pair_event> events_;
};

}  // namespace plcgw
