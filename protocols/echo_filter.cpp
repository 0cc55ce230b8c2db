#include "protocols/echo_filter.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

// A client that writes the same value again looks like the echo of the reply to its last write. An echo that was taken
// for a request would be answered, and that answer echoed, for ever: the fourth copy at once behind its reply is no
// client. A client that writes the same each second comes later than an echo.
constexpr unsigned most_copies = 3;

}  // namespace

echo_filter::echo_filter(local_echo mode) : mode_(mode)
{
    if (mode != local_echo::automatic)
        echoes_ = mode == local_echo::on;
}

void echo_filter::sent(bytes adu, bool like_request, time_point echo_until)
{
    matched_ = 0;
    echo_until_ = echo_until;
    like_request_ = like_request;
    expected_.clear();
    const bool tells = mode_ == local_echo::automatic && (!like_request || !echoes_.has_value());
    if (tells || echoes_.value_or(false))
        expected_.assign(adu.begin(), adu.end());
}

buffer echo_filter::feed(time_point now, bytes received)
{
    buffer rest;
    while (!received.empty() && !expected_.empty()) {
        if (received.front() != expected_[matched_]) {
            rest = broken_copy();
            break;
        }
        received = received.subspan(1);
        if (++matched_ == expected_.size())
            rest = whole_copy(now);
    }
    rest.insert(rest.end(), received.begin(), received.end());
    return rest;
}

// What is left of it for others: nothing if it is an echo.
buffer echo_filter::whole_copy(time_point now)
{
    buffer copy = std::exchange(expected_, {});
    if (mode_ == local_echo::automatic && like_request_ && now > echo_until_) {
        copies_ = 0;
        echoes_.reset();  // not known after all: the echo should have come
        return copy;
    }
    if (!echoes_.has_value() && like_request_ && ++copies_ <= most_copies)
        return copy;
    if (mode_ == local_echo::automatic)
        echoes_ = true;
    return {};
}

buffer echo_filter::broken_copy()
{
    if (mode_ == local_echo::automatic && !like_request_)
        echoes_ = false;
    copies_ = 0;
    buffer copy = std::exchange(expected_, {});
    copy.resize(std::exchange(matched_, 0));
    return copy;
}

}  // namespace plcgw
