#include "daemon/tcp_connect.hpp"

#include <boost/asio/connect.hpp>

namespace plcgw {

using asio::ip::tcp;
using boost::system::error_code;

asio::awaitable<error_code> connect_before(time_point deadline, tcp::socket& socket, deadline_guard<tcp::socket>& guard,
                                           std::string host, unsigned port)
{
    tcp::resolver resolver(socket.get_executor());
    const std::string service = std::to_string(port);
    const auto [failed, found] = co_await resolver.async_resolve(host, service, no_throw);
    if (failed)
        co_return failed;

    error_code last = asio::error::host_not_found;
    for (const auto& each : found) {
        const tcp::endpoint endpoint = each.endpoint();
        error_code ignored;
        socket.close(ignored);
        if (socket.open(endpoint.protocol(), last); last)
            continue;
        guard.arm(deadline);
        const auto [ec] = co_await socket.async_connect(endpoint, no_throw);
        const bool cut_short = guard.disarm();
        last = cut_short ? error_code(asio::error::timed_out) : ec;
        if (!last)
            break;
    }
    if (!last) {
        error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::keep_alive(true), ignored);
    }
    co_return last;
}

}  // namespace plcgw
