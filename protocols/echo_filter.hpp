// Takes a server's own replies away from what it hears: two-wire adapters may return what they send.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/serial_timing.hpp"
#include "protocols/time.hpp"

#include <optional>

namespace plcgw {

class echo_filter {
public:
    explicit echo_filter(local_echo mode);

    // This was handed to the driver. like_request: a client may send the same bytes as a request (functions 05, 06,
    // 08). echo_until: what comes later is no echo of it, as far as that is in doubt.
    void sent(bytes adu, bool like_request, time_point echo_until);

    // What others said. Bytes that may still become the echo are held back until more come.
    buffer feed(time_point now, bytes received);

    // What is known of the line; nothing while only replies were sent that do not tell.
    std::optional<bool> echoes() const { return echoes_; }

private:
    buffer whole_copy(time_point now);
    buffer broken_copy();

    local_echo mode_;
    std::optional<bool> echoes_;
    buffer expected_;  // empty: nothing was sent, or its echo is over
    std::size_t matched_ = 0;
    bool like_request_ = false;
    unsigned copies_ = 0;  // in a row, at once, of replies that do not tell
    time_point echo_until_{};
};

}  // namespace plcgw
