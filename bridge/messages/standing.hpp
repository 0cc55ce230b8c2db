// How far the words of one row of a general-purpose line can be trusted, and when they were said on DDS.
#pragma once

#include "bridge/routes/quality.hpp"
#include "protocols/time.hpp"

namespace plcgw::messages {

class standing {
public:
    quality state() const { return state_; }
    wall_time source() const { return source_; }
    time_point good_at() const { return good_at_; }

    void renew(time_point now, wall_time wall);  // a message brought the words
    void change() { changed_ = true; }           // they have to be said
    void lose();                                 // nobody can renew them now; what never came stays so
    void age(time_point now, duration longest);  // 0: never stale

    bool due(time_point now, duration longest_silence);  // to be said now; then it counts as said
    time_point wake_at(duration longest_silence, duration longest) const;

private:
    void set(quality state);

    quality state_ = quality::never_read;
    wall_time source_ = wall_time::never;
    time_point good_at_{};
    time_point said_at_{};
    bool changed_ = true;  // since it was said: the first one says "never read"
    bool confirmed_ = false;
};

}  // namespace plcgw::messages
