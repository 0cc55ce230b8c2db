#include "daemon/look_up.hpp"
#include "tests/daemon/await.hpp"

#include <doctest/doctest.h>

#include <future>

TEST_SUITE_BEGIN("tcp");

using namespace plcgw;
using asio::ip::tcp;
using boost::system::error_code;
using namespace std::chrono_literals;

namespace {

const tcp::endpoint somewhere(asio::ip::make_address("192.0.2.1"), 502);

boost::system::result<tcp_endpoints> look_up_now(std::string host, duration patience, resolver resolve)
{
    asio::io_context loop;
    return await(loop, look_up(now() + patience, loop.get_executor(), std::move(host), 502, std::move(resolve)));
}

boost::system::result<tcp_endpoints> must_not_be_asked(const std::string&, unsigned)
{
    FAIL_CHECK("an address needs no resolver");
    return error_code(asio::error::host_not_found);
}

}  // namespace

TEST_CASE("look-up: an address is its own answer")
{
    for (const char* address : {"127.0.0.1", "::1", "fe80::1%lo"}) {
        INFO(address);
        const auto found = look_up_now(address, 20s, must_not_be_asked);
        REQUIRE(found.has_value());
        REQUIRE(found->size() == 1);
        CHECK(found->front() == tcp::endpoint(asio::ip::make_address(address), 502));
    }
}

TEST_CASE("look-up: names are asked for, and every address comes back in its order")
{
    const auto found = look_up_now("gateway.test", 20s, [](const std::string& host, unsigned port) {
        CHECK(host == "gateway.test");
        CHECK(port == 502);
        return tcp_endpoints{somewhere, tcp::endpoint(tcp::v4(), 1)};
    });
    REQUIRE(found.has_value());
    CHECK((*found == tcp_endpoints{somewhere, tcp::endpoint(tcp::v4(), 1)}));
}

TEST_CASE("look-up: the resolver's failure is told")
{
    const auto found = look_up_now("gateway.test", 20s, [](const std::string&, unsigned) {
        return boost::system::result<tcp_endpoints>(error_code(asio::error::host_not_found));
    });
    REQUIRE_FALSE(found.has_value());
    CHECK(found.error() == asio::error::host_not_found);
}

TEST_CASE("look-up: a resolver that takes too long is left to itself")
{
    std::promise<void> enough;
    std::promise<void> ended;
    const std::shared_future<void> may_end = enough.get_future().share();
    const auto found = look_up_now("gateway.test", 50ms, [&ended, may_end](const std::string&, unsigned) {
        may_end.wait();
        ended.set_value();
        return boost::system::result<tcp_endpoints>(tcp_endpoints{somewhere});
    });
    REQUIRE_FALSE(found.has_value());
    CHECK(found.error() == asio::error::timed_out);
    enough.set_value();  // its answer comes after everything is gone
    CHECK(ended.get_future().wait_for(20s) == std::future_status::ready);
}

TEST_CASE("look-up: this host's name server list knows localhost")
{
    const auto found = look_up_now("localhost", 20s, ask_resolver);
    REQUIRE(found.has_value());
    for (const tcp::endpoint& each : *found) {
        CHECK(each.address().is_loopback());
        CHECK(each.port() == 502);
    }
}

TEST_SUITE_END();
