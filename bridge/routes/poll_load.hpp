// Whether the polls of a line fit into it, and by how much their periods have to be stretched if not: all by the same
// factor, so that an overloaded line is evenly slow.
#pragma once

#include "protocols/time.hpp"

#include <cstddef>
#include <vector>

namespace plcgw {

class poll_load {
public:
    // Numbered from 0, in the order of these calls. A period of 0: an item that is no poll.
    void add(duration period) { polls_.push_back({period, {}, true}); }

    void took(std::size_t index, duration time);      // one transaction
    void set_asked(std::size_t index, bool is);       // false: its station is down, it takes no time
    void others_took(duration time, time_point now);  // a transaction that was no poll, which ended now

    // Line time per second that the polls want, as far as they were timed: 1.37 is 137 %.
    double wanted() const { return wanted_; }
    // 1 or more. parallel: so many transactions can be under way at a time; others_took() counts line time as it is.
    double stretch(time_point now, unsigned parallel) const;

private:
    struct poll {
        duration period{};
        duration cost{};  // smoothed; 0 = not timed yet
        bool asked{};
    };
    static double share_of(const poll& p);

    std::vector<poll> polls_;
    double wanted_ = 0;
    double others_ = 0;  // line time per second of other work, over the last seconds
    time_point others_at_{};
};

}  // namespace plcgw
