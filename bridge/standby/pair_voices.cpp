// On which lines a member speaks: listening before talking, and giving way where somebody else is heard.
#include "bridge/standby/pair.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace plcgw {
namespace {

using severity = pair_event::severity;

}  // namespace

time_point standby_pair::speaks_until(std::size_t line) const { return lines_[line].speaks_until(lease_until_); }

// From its name, and another one after each meeting: two members that know nothing of each other come apart.
duration standby_pair::slot() const
{
    constexpr unsigned slots = 8;
    if (other_is_ != other_state::unknown && attempts_ == 0)
        return {};
    duration longest{};
    for (const pair_line& each : lines_)
        longest = std::max(longest, each.settings().quiet);
    const std::size_t chosen = std::hash<std::string>{}(settings_.member + std::to_string(attempts_)) % slots;
    return longest / 2 * static_cast<int>(chosen);
}

// Liveliness is lost, or was never there: only the lines say whether the other member still works.
void standby_pair::take_over_if_quiet(time_point now)
{
    const bool has_left = other_is_ == other_state::left;
    const auto busy = std::find_if(lines_.begin(), lines_.end(), [&](const pair_line& each) {
        return !each.speaks() && !each.is_quiet(now, slot());
    });
    if (!has_left && busy != lines_.end()) {
        if (!std::exchange(busy_said_, true))
            say(severity::info, "line " + busy->settings().name + " is not silent: this member stays standby");
        take_silent_lines(now);
        return;
    }
    term_ = std::max(term_, other_ ? other_->term : 0) + 1;
    const std::string who = other_ ? "member " + other_->member : "another member";
    become(now, pair_role::active,
           other_is_ == other_state::unknown ? who + " is not heard" : who + (has_left ? " has left" : " is lost"));
    look_as_active(now);
}

// Not all of them: the other member speaks on some, but cannot on these.
void standby_pair::take_silent_lines(time_point now)
{
    for (pair_line& each : lines_) {
        if (each.heard_others()) {
            each.hold_back(now);
            ++attempts_;
            say(severity::warning, "line " + each.settings().name + ": the other member speaks again");
        }
        else if (!each.speaks() && each.is_silent(now, slot())) {
            each.begin(now);
            say(severity::warning, "line " + each.settings().name +
                                       " is silent for its limit, and the other member is not heard: it is taken");
        }
        each.look(now, certainty::guessed, beat_period());
    }
}

void standby_pair::look_as_active(time_point now)
{
    offers_ = offers_ && now < offers_until_;
    const bool is_agreed = other_is_ == other_state::left || (other_lives() && other_->role != pair_role::active);
    const certainty how = is_agreed ? certainty::agreed : certainty::guessed;
    bool works = false;
    bool gave_way = false;
    for (pair_line& each : lines_) {
        look_at_held_back(now, each, how);
        const bool may_begin = !each.is_held_back() && each.is_free(now) && (is_agreed || each.is_quiet(now));
        if (!each.speaks() && may_begin)
            each.begin(now);
        each.look(now, how, beat_period());
        works = works || (each.speaks() && each.can_hear());
        gave_way = gave_way || each.is_held_back();
    }
    if (gave_way && !works)
        become(now, pair_role::standby, "the other member speaks on the lines");
}

void standby_pair::look_at_held_back(time_point now, pair_line& line, certainty how)
{
    if (how == certainty::agreed) {
        if (line.is_held_back())
            line.begin(now);
        return;
    }
    if (line.is_held_back()) {
        if (line.is_silent(now, slot()))
            line.begin(now);
        return;
    }
    // Who took over without the other's knowledge knows that its own term is the higher one; the other guesses so.
    const bool comes_first = other_ && term_ > other_->term;
    if (!line.heard_others() || other_lives() || comes_first)
        return;
    line.hold_back(now);
    ++attempts_;
    say(severity::warning, "line " + line.settings().name + ": another member speaks there, this one is silent now");
}

}  // namespace plcgw
