#include "daemon/upstream.hpp"

#include "daemon/line_events.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

namespace plcgw {

void upstream_watch::add(const route_config& from, const find_plc& plc)
{
    const route r = make_route(from, plc);
    guards_.add({r.name, r.plc, r.at, bits_of(r), from.upstream.longest_silence, packed_values(r, from.upstream.safe)});
}

void upstream_watch::start()
{
    if (guards_.empty())
        return;
    guards_.start(now());
    boost::asio::co_spawn(loop_, keep_time(), boost::asio::detached);
}

void upstream_watch::written()
{
    guards_.written(now());
    log_events();
    const time_point next = guards_.wake_at();
    if (next != time_point::max() && next < timer_.expiry())
        timer_.cancel();
}

boost::asio::awaitable<void> upstream_watch::keep_time()
{
    constexpr duration idle = std::chrono::hours(1);
    for (;;) {
        const time_point at = now();
        timer_.expires_at(std::min(guards_.wake_at(), at + idle));
        co_await timer_.async_wait(no_throw);
        if (!gate_.is_open()) {
            co_await gate_.wait();
            guards_.start(now());  // whoever writes has his whole time
            continue;
        }
        guards_.look(now());
        log_events();
        settle_();
    }
}

void upstream_watch::log_events() { plcgw::log_events(guards_.take_events()); }

}  // namespace plcgw
