#include "daemon/tcp_connect.hpp"
#include "tests/daemon/await.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("tcp");

using namespace plcgw;
using asio::ip::tcp;
using boost::system::error_code;
using namespace std::chrono_literals;

namespace {

// Listens, but its queue is full: further SYNs are dropped, as by a host that is switched off.
struct silent_server {
    explicit silent_server(asio::io_context& loop) : acceptor(loop), first(loop)
    {
        acceptor.open(tcp::v4());
        acceptor.bind({asio::ip::make_address("127.0.0.2"), 0});
        acceptor.listen(0);  // Linux lets one wait
        at = acceptor.local_endpoint();
        first.connect(at);
        acceptor.wait(tcp::acceptor::wait_read);
    }
    tcp::acceptor acceptor;
    tcp::socket first;
    tcp::endpoint at;
};

error_code connect(asio::io_context& loop, tcp::socket& to, duration patience, const tcp_endpoints& endpoints)
{
    deadline_guard<tcp::socket> guard(to);
    return await(loop, connect_to_any(now() + patience, to, guard, endpoints));
}

}  // namespace

TEST_CASE("connect: an address that drops everything leaves time for the next one")
{
    asio::io_context loop;
    silent_server silent(loop);
    tcp::acceptor good(loop, {asio::ip::make_address("127.0.0.1"), 0});
    tcp::socket socket(loop);
    CHECK(connect(loop, socket, 2s, {silent.at, good.local_endpoint()}) == error_code{});
    REQUIRE(socket.is_open());
    CHECK(socket.remote_endpoint() == good.local_endpoint());
}

TEST_CASE("connect: when all drop everything, the deadline is kept")
{
    asio::io_context loop;
    silent_server silent(loop);
    tcp::socket socket(loop);
    const time_point begun = now();
    CHECK(connect(loop, socket, 300ms, {silent.at, silent.at, silent.at}) == asio::error::timed_out);
    CHECK(now() - begun >= 290ms);
    CHECK(now() - begun < 20s);
}

TEST_CASE("connect: an address that refuses uses up no time")
{
    asio::io_context loop;
    tcp::endpoint closed;
    {
        tcp::acceptor gone(loop, {asio::ip::make_address("127.0.0.1"), 0});
        closed = gone.local_endpoint();
    }
    tcp::socket socket(loop);
    CHECK(connect(loop, socket, 20s, {closed}) == asio::error::connection_refused);
    CHECK(connect(loop, socket, 20s, {}) == asio::error::host_not_found);
}

TEST_SUITE_END();
