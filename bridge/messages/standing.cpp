#include "bridge/messages/standing.hpp"

#include <algorithm>

namespace plcgw::messages {

void standing::renew(time_point now, wall_time wall)
{
    set(quality::good);
    source_ = wall;
    good_at_ = now;
    confirmed_ = true;
}

void standing::lose()
{
    if (state_ != quality::never_read)
        set(quality::comm_error);
}

void standing::age(time_point now, duration longest)
{
    if (longest > duration{} && state_ == quality::good && now - good_at_ >= longest)
        set(quality::stale);
}

bool standing::due(time_point now, duration longest_silence)
{
    if (!changed_ && (!confirmed_ || now - said_at_ < longest_silence))
        return false;
    changed_ = confirmed_ = false;
    said_at_ = now;
    return true;
}

time_point standing::wake_at(duration longest_silence, duration longest) const
{
    time_point soonest = time_point::max();
    if (confirmed_)
        soonest = said_at_ + longest_silence;
    if (longest > duration{} && state_ == quality::good)
        soonest = std::min(soonest, good_at_ + longest);
    return soonest;
}

void standing::set(quality state)
{
    changed_ = changed_ || state_ != state;
    state_ = state;
}

}  // namespace plcgw::messages
