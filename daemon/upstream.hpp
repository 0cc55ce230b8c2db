// Keeps the time of those who write the devices of the PLCs: safe values when they fall silent.
#pragma once

#include "bridge/routes/upstream_guards.hpp"
#include "daemon/answer_gate.hpp"
#include "daemon/running_line.hpp"

#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>

namespace plcgw {

class upstream_watch {
public:
    // settle: called after safe values were put into a memory.
    upstream_watch(boost::asio::io_context& loop, std::function<void()> settle)
        : loop_(loop), settle_(std::move(settle)), timer_(loop), gate_(loop)
    {
    }

    void add(const route_config& from, const find_plc& plc);
    void start();
    void obey(const line_voice& voice) { gate_.obey(voice); }  // of a pair: the standby guards nothing
    void written();                                            // somebody wrote to a PLC

private:
    boost::asio::awaitable<void> keep_time();
    void log_events();

    boost::asio::io_context& loop_;
    std::function<void()> settle_;
    boost::asio::steady_timer timer_;
    answer_gate gate_;
    upstream_guards guards_;
};

}  // namespace plcgw
