#include "bridge/standby/pair_line.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

constexpr duration pause_after_answer = std::chrono::milliseconds(20);

}  // namespace

void pair_line::heard(const line_heard& what)
{
    const bool has_come = what.listens && what.port_open && !heard_.port_open;
    heard_ = what;
    if (has_come && how_ == certainty::guessed)
        stop(stopped_);  // who knows what goes on there: listen first
    if (!speaks_ && what.anything && *what.anything > stopped_ + settings_.quiet)
        tried_ = false;
}

void pair_line::listen_anew(time_point now)
{
    stop(now);
    listens_since_ = stopped_ = now;
    held_back_ = false;
}

duration pair_line::silent_for(time_point now) const
{
    const time_point since = std::max({heard_.open_since, listens_since_, heard_.anything.value_or(time_point{})});
    return now - since;
}

bool pair_line::is_free(time_point now) const
{
    if (!heard_.foreign_request || now - *heard_.foreign_request >= settings_.quiet)
        return true;
    const bool was_answered = heard_.anything && *heard_.anything > *heard_.foreign_request;
    return was_answered && now - *heard_.anything >= pause_after_answer;
}

std::optional<duration> pair_line::asked(time_point now) const
{
    return heard_.asked ? std::optional<duration>(now - *heard_.asked) : std::nullopt;
}

bool pair_line::missed(time_point now, duration asked_ago) const
{
    constexpr duration on_its_way = std::chrono::milliseconds(300);
    return can_hear() && silent_for(now) > asked_ago + on_its_way;
}

line_report pair_line::report(time_point now) const
{
    if (!heard_.listens)
        return line_report::unknown;
    if (!heard_.port_open)
        return line_report::closed;
    if (!settings_.polled)
        return line_report::unknown;
    return silent_for(now) >= settings_.limit ? line_report::mute : line_report::good;
}

void pair_line::begin(time_point now)
{
    speaks_ = true;
    held_back_ = false;
    since_ = listens_since_ = now;  // it has its whole limit to find somebody
    moment_ends_ = time_point::max();
}

void pair_line::stop(time_point now)
{
    if (!std::exchange(speaks_, false))
        return;
    tried_ = true;
    stopped_ = now;
}

void pair_line::hold_back(time_point now)
{
    stop(now);
    held_back_ = true;
}

bool pair_line::heard_others() const { return speaks_ && heard_.foreign_request && *heard_.foreign_request > since_; }

void pair_line::look(time_point now, certainty how, duration moment)
{
    how_ = how;
    const bool lives = !heard_.listens || silent_for(now) < settings_.quiet;
    if (how == certainty::agreed || lives) {
        moment_ends_ = time_point::max();
        return;
    }
    if (moment_ends_ == time_point::max()) {
        moment_ends_ = now;
        next_moment_ = now + settings_.quiet / 2;
    }
    if (now < next_moment_)
        return;
    moment_ends_ = now + moment;
    next_moment_ = moment_ends_ + settings_.quiet / 2;
}

time_point pair_line::speaks_until(time_point lease_until) const
{
    const bool is_blind = how_ == certainty::guessed && heard_.listens && !heard_.port_open;
    return speaks_ && !is_blind ? std::min(lease_until, moment_ends_) : time_point::min();
}

}  // namespace plcgw
