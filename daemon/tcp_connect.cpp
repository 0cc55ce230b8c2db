#include "daemon/tcp_connect.hpp"

namespace plcgw {

using asio::ip::tcp;
using boost::system::error_code;

asio::awaitable<error_code> connect_before(time_point deadline, tcp::socket& socket, deadline_guard<tcp::socket>& guard,
                                           std::string host, unsigned port)
{
    const asio::any_io_executor executor = socket.get_executor();
    const resolver resolve = ask_resolver;
    auto found = co_await look_up(deadline, executor, host, port, resolve);
    if (!found)
        co_return found.error();
    const error_code ec = co_await connect_to_any(deadline, socket, guard, *found);
    co_return ec;
}

asio::awaitable<error_code> connect_to_any(time_point deadline, tcp::socket& socket, deadline_guard<tcp::socket>& guard,
                                           tcp_endpoints endpoints)
{
    error_code ignored;
    error_code last = asio::error::host_not_found;
    for (std::size_t i = 0; i < endpoints.size(); ++i) {
        socket.close(ignored);
        if (socket.open(endpoints[i].protocol(), last); last)
            continue;
        const auto left = static_cast<duration::rep>(endpoints.size() - i);
        const time_point until = now() + (deadline - now()) / left;
        guard.arm(until);
        const auto [ec] = co_await socket.async_connect(endpoints[i], no_throw);
        const bool cut_short = guard.disarm();
        last = cut_short && ec ? error_code(asio::error::timed_out) : ec;
        if (!last)
            break;
    }
    if (!last) {
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::keep_alive(true), ignored);
    }
    co_return last;
}

}  // namespace plcgw
