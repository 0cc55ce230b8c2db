// Counts what passes a port, where it passes: one for each line and listener. Nothing is allocated for a frame.
#pragma once

#include "bridge/link_status.hpp"

#include <boost/system/error_code.hpp>

#include <cstddef>
#include <utility>

namespace plcgw {

class port_meter {
public:
    explicit port_meter(std::string port = {})
    {
        status_.port = std::move(port);
        status_.state = link_state::starting;
    }

    void opened(wall_time at)
    {
        if (std::exchange(was_open_, true))
            ++status_.reopens;
        become(link_state::up, at);
    }
    void lost(wall_time at, std::string why)
    {
        become(link_state::down, at);
        status_.detail = std::move(why);
        last_fault_ = {};
    }

    void sent(std::size_t size) { status_.tx_bytes += size; }
    void received(std::size_t size) { status_.rx_bytes += size; }
    void frames_sent(std::uint64_t count = 1) { status_.tx_frames += count; }
    void frames_received(std::uint64_t count = 1) { status_.rx_frames += count; }

    // A frame was dropped, or bytes are none. The text is made once for a row of the same fault.
    void fault(const boost::system::error_code& why)
    {
        ++status_.errors;
        if (why != last_fault_ || status_.detail.empty())
            status_.detail = why.message();
        last_fault_ = why;
    }

    const port_status& status() const { return status_; }

private:
    void become(link_state state, wall_time at)
    {
        if (std::exchange(status_.state, state) != state || status_.since == wall_time::never)
            status_.since = at;
    }

    port_status status_;
    bool was_open_ = false;
    boost::system::error_code last_fault_;
};

}  // namespace plcgw
