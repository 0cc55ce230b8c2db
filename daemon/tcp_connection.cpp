#include "daemon/tcp_connection.hpp"

#include "daemon/log.hpp"
#include "daemon/tcp_connect.hpp"

#include <boost/asio/write.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using boost::system::error_code;

constexpr milliseconds first_pause{200};
constexpr milliseconds last_pause{10'000};
constexpr milliseconds connect_timeout{5'000};
constexpr milliseconds write_timeout{5'000};  // a server that takes nothing for so long is gone
constexpr duration short_life = std::chrono::seconds(1);

}  // namespace

tcp_connection::tcp_connection(asio::io_context& loop, const line_config& line)
    : line_(line), socket_(loop), guard_(socket_), pause_(loop), next_pause_(first_pause)
{
}

asio::awaitable<bool> tcp_connection::open()
{
    if (!std::exchange(wait_first_, false)) {
        const time_point deadline = now() + connect_timeout;
        const error_code ec = co_await connect_before(deadline, socket_, guard_, line_.host, line_.port);
        if (!ec) {
            log::info("line {}: connected to {}:{}", line_.name, line_.host, line_.port);
            opened_at_ = now();
            said_ = false;
            co_return true;
        }
        error_code ignored;
        socket_.close(ignored);
        say_absent(ec);
    }
    pause_.expires_after(next_pause_);
    next_pause_ = std::min(2 * next_pause_, last_pause);
    co_await pause_.async_wait(no_throw);
    co_return false;
}

// A server that accepts and hangs up at once is asked ever more rarely, too.
void tcp_connection::close(const error_code& why)
{
    error_code ignored;
    socket_.close(ignored);
    wait_first_ = true;
    if (now() - opened_at_ >= short_life)
        next_pause_ = first_pause;
    say_absent(why);
}

void tcp_connection::say_absent(const error_code& why)
{
    if (!std::exchange(said_, true))
        log::warning("line {}: no connection to {}:{} ({}): it is tried again until there is one", line_.name,
                     line_.host, line_.port, why.message());
}

asio::awaitable<error_code> tcp_connection::write(bytes adu)
{
    guard_.arm(now() + write_timeout);
    const auto [ec, size] = co_await asio::async_write(socket_, asio::buffer(adu.data(), adu.size()), no_throw);
    const bool cut_short = guard_.disarm();
    if (ec == asio::error::operation_aborted && cut_short)
        co_return error_code(asio::error::timed_out);
    co_return ec;
}

asio::awaitable<boost::system::result<std::size_t>> tcp_connection::read(time_point deadline, asio::mutable_buffer into)
{
    const auto size = co_await read_before(deadline, socket_, guard_, into);
    co_return size;
}

}  // namespace plcgw
