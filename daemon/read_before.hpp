// The only timeout of the daemon's drivers: an operation on a port or socket that is cancelled at a deadline.
#pragma once

#include "protocols/time.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/system/result.hpp>

#include <algorithm>
#include <unistd.h>

namespace plcgw {

namespace asio = boost::asio;

inline constexpr auto no_throw = asio::as_tuple(asio::use_awaitable);  // failures are values

inline time_point now() { return std::chrono::time_point_cast<duration>(std::chrono::steady_clock::now()); }

inline wall_time wall_now()
{
    const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
    return wall_time{std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count()};
}

// Cancels what a stream is doing when the deadline comes. One for each stream, living as long as it.
template <class Stream>
class deadline_guard {
public:
    explicit deadline_guard(Stream& stream) : stream_(stream), timer_(stream.get_executor()) {}

    void arm(time_point deadline)
    {
        // time_point::max() means never; as nanoseconds of the timer it would overflow.
        constexpr duration long_enough = std::chrono::hours(1);
        timer_.expires_at(std::min(deadline, now() + long_enough));
        timer_.async_wait([this, turn = ++turn_](boost::system::error_code cancelled) {
            if (!cancelled && turn == turn_)  // a late handler must not cancel the next operation
                cancel();
        });
    }

    // The operation is over. True when it was cut short by the deadline or by interrupt().
    bool disarm()
    {
        ++turn_;
        timer_.cancel();
        return std::exchange(cut_short_, false);
    }

    // Ends the running operation as if its deadline had come.
    void interrupt() { cancel(); }

private:
    void cancel()
    {
        cut_short_ = true;
        boost::system::error_code ignored;
        stream_.cancel(ignored);
    }

    Stream& stream_;
    asio::basic_waitable_timer<std::chrono::steady_clock> timer_;
    std::uint64_t turn_ = 0;
    bool cut_short_ = false;
};

// Bytes read before the deadline; asio::error::timed_out when it came first. The descriptor is non-blocking.
template <class Stream>
asio::awaitable<boost::system::result<std::size_t>>
read_before(time_point deadline, Stream& stream, deadline_guard<Stream>& guard, asio::mutable_buffer into)
{
    guard.arm(deadline);
    const auto [ec, size] = co_await stream.async_read_some(into, no_throw);
    const bool cut_short = guard.disarm();
    if (!ec)
        co_return size;
    if (ec != asio::error::operation_aborted || !cut_short)
        co_return ec;
    // Bytes may have come while this process or its machine stood still: they were in time, we were late.
    const ssize_t late = ::read(stream.native_handle(), into.data(), into.size());
    if (late > 0)
        co_return static_cast<std::size_t>(late);
    co_return boost::system::error_code(asio::error::timed_out);
}

}  // namespace plcgw
