#include "daemon/tcp_connection.hpp"

#include "daemon/line_events.hpp"
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
// A connection on which nothing comes is given up after so many questions and so much time; it is longer each time that
// a new one did not help: the stations behind it may just be off.
constexpr unsigned most_missed = 3;
constexpr duration first_patience = std::chrono::seconds(5);
constexpr duration last_patience = std::chrono::minutes(5);

// A peer without power is noticed: by keep-alive, or when it does not confirm what was sent.
void set_options(asio::ip::tcp::socket& socket)
{
    using idle = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
    using interval = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
    using count = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPCNT>;
    using unconfirmed = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
    error_code ignored;
    socket.set_option(idle(10), ignored);
    socket.set_option(interval(5), ignored);
    socket.set_option(count(3), ignored);
    socket.set_option(unconfirmed(15'000), ignored);
}

}  // namespace

tcp_connection::tcp_connection(asio::io_context& loop, const line_config& line)
    : line_connection(line.name), line_(line), socket_(loop), guard_(socket_), pause_(loop), next_pause_(first_pause),
      patience_(first_patience)
{
}

asio::awaitable<bool> tcp_connection::open()
{
    if (!std::exchange(wait_first_, false)) {
        const time_point deadline = now() + connect_timeout;
        const error_code ec = co_await connect_before(deadline, socket_, guard_, line_.host, line_.port);
        if (!ec) {
            meter_.opened(wall_now());
            say(line_event::severity::info, "port.open", line_.name, "line {}: connected to {}:{}", line_.name,
                line_.host, line_.port);
            set_options(socket_);
            opened_at_ = heard_ = now();
            missed_ = 0;
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
    if (deaf())
        patience_ = std::min(2 * patience_, last_patience);
    if (now() - opened_at_ >= short_life)
        next_pause_ = first_pause;
    say_absent(why);
}

void tcp_connection::rest()
{
    error_code ignored;
    socket_.close(ignored);
    log::info("line {}: disconnected from {}:{}: the other member of the pair asks", line_.name, line_.host,
              line_.port);
}

void tcp_connection::say_absent(const error_code& why)
{
    meter_.lost(wall_now(), fmt::format("no connection to {}:{}: {}", line_.host, line_.port, why.message()));
    if (!std::exchange(said_, true))
        say(line_event::severity::warning, "port.lost", line_.name,
            "line {}: no connection to {}:{} ({}): it is tried again until there is one", line_.name, line_.host,
            line_.port, why.message());
}

asio::awaitable<error_code> tcp_connection::write(bytes adu)
{
    guard_.arm(now() + write_timeout);
    const auto [ec, size] = co_await asio::async_write(socket_, asio::buffer(adu.data(), adu.size()), no_throw);
    const bool cut_short = guard_.disarm();
    meter_.sent(size);
    if (ec == asio::error::operation_aborted && cut_short)
        co_return error_code(asio::error::timed_out);
    co_return ec;
}

asio::awaitable<boost::system::result<std::size_t>> tcp_connection::read(time_point deadline, asio::mutable_buffer into)
{
    const auto size = co_await read_before(deadline, socket_, guard_, into);
    if (size) {
        meter_.received(*size);
        heard_ = now();
        missed_ = 0;
        patience_ = first_patience;
    }
    co_return size;
}

bool tcp_connection::deaf() const { return missed_ >= most_missed && now() - heard_ >= patience_; }

}  // namespace plcgw
