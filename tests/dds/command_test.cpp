// Requests and replies between a client and a gateway's port, on the loopback interface.
#include "bridge/dds/command_client.hpp"
#include "bridge/dds/command_port.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <optional>

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr wall_time noon{1'700'000'000'000'000'000};

command_port port(const char* gateway, const char* member = "member-1")
{
    auto made = command_port::create(own_domain(), {gateway, member, "0.1.0", "abc"});
    REQUIRE_MESSAGE(made.has_value(), made.error().text);
    return std::move(*made);
}

struct asker {
    command_client out = [] {
        auto made = command_client::create(own_domain());
        REQUIRE_MESSAGE(made.has_value(), made.error().text);
        return std::move(*made);
    }();

    // Repeats the request until the gateway has it, as clients do.
    std::optional<order_request> meet(command_port& gateway, const order_request& request)
    {
        const auto end = steady::now() + deadline;
        while (steady::now() < end) {
            CHECK(out.send(request));
            ::pollfd ready{gateway.descriptor(), POLLIN, 0};
            ::poll(&ready, 1, 100);
            for (command_news& each : gateway.take())
                if (auto* const got = std::get_if<order_request>(&each); got != nullptr && got->key == request.key)
                    return std::move(*got);
        }
        return std::nullopt;
    }
    // The reply, which the gateway repeats.
    std::optional<order_reply> hear(command_port& gateway, const order_key& key, const order_outcome& outcome)
    {
        const auto end = steady::now() + deadline;
        while (steady::now() < end) {
            gateway.reply(key, outcome, noon);
            ::pollfd ready{out.descriptor(), POLLIN, 0};
            ::poll(&ready, 1, 100);
            for (order_reply& each : out.take())
                if (each.key == key)
                    return std::move(each);
        }
        return std::nullopt;
    }
};

order_request request(order_content what, std::uint64_t id = 7)
{
    order_request out;
    out.key = {"panel", id};
    out.gateway = "gw";
    out.what.what = std::move(what);
    out.what.given = noon;
    out.what.timeout = 1500ms;
    return out;
}

}  // namespace

TEST_CASE("dds requests: registers, points and messages come as they were sent")
{
    auto gateway = port("gw");
    asker client;
    const order_request sent[] = {
        request(route_order{"pump.set", "holding", 70000, {false, 3, {1, 0x8000, 65535}}}, 1),
        request(route_order{"pump.coils", "coil", 3, {true, 17, {0xFFFF, 1}}}, 2),
        request(route_order{"long", "holding", 0, {false, 1024, std::vector<std::uint16_t>(1024, 9)}}, 3),
        request(point_order{"boiler.temp", {point_kind::real, -21.5, -21, ""}}, 4),
        request(point_order{std::string(128, 'n'), {point_kind::text, 0, 0, std::string(255, 't')}}, 5),
        request(message_order{"scale", {'W', 0, 0xFF, '\r'}}, 6),
    };
    for (const order_request& each : sent) {
        CAPTURE(each.key.request);
        const auto got = client.meet(gateway, each);
        REQUIRE(got);
        CHECK(got->malformed == "");
        CHECK(got->gateway == "gw");
        CHECK(got->what.given == noon);
        CHECK(got->what.timeout == 1500ms);
        const bool same = std::visit(
            [&](const auto& was) {
                using content = std::decay_t<decltype(was)>;
                if constexpr (requires { was == was; })
                    return std::holds_alternative<content>(got->what.what) && std::get<content>(got->what.what) == was;
                else
                    return false;
            },
            each.what.what);
        CHECK(same);
    }
}

TEST_CASE("dds requests: what means nothing is marked, and what is too long is not sent")
{
    auto gateway = port("gw");
    asker client;
    const order_request bad[] = {
        request(route_order{"r", "holding", 0, {false, 2, {1}}}, 1),
        request(route_order{"r", "holding", 0, {false, 0, {}}}, 2),
        request(route_order{"r", "coil", 0, {true, 17, {1}}}, 3),
        request(point_order{"p", {}}, 4),
    };
    for (const order_request& each : bad) {
        const auto got = client.meet(gateway, each);
        REQUIRE(got);
        CHECK(got->malformed != "");
    }
    order_request nobody = request(point_order{"p", {point_kind::integer, 1, 1, ""}}, 5);
    nobody.key.client = "";
    const auto got = client.meet(gateway, nobody);
    REQUIRE(got);
    CHECK(got->malformed.find("client") != std::string::npos);

    CHECK_FALSE(
        client.out.send(request(route_order{"r", "holding", 0, {false, 1025, std::vector<std::uint16_t>(1025)}})));
    CHECK_FALSE(client.out.send(request(message_order{"scale", buffer(4097)})));
    CHECK_FALSE(client.out.send(request(device_order{})));

    const point_value one{point_kind::integer, 1, 1, ""};
    order_request named = request(point_order{std::string(129, 'p'), one});  // cut off it would be another point
    CHECK_FALSE(client.out.send(named));
    named = request(point_order{"p", one});
    named.key.client = std::string(65, 'c');
    CHECK_FALSE(client.out.send(named));
    named.key.client.pop_back();
    CHECK(client.out.send(named));
}

TEST_CASE("dds requests: only those to this gateway; replies of the other member are heard, our own are not")
{
    auto ours = port("gw");
    auto partner = port("gw", "member-2");
    auto other = port("other");
    asker client;
    const order_request sent = request(point_order{"p", {point_kind::integer, 1, 1, ""}});
    REQUIRE(client.meet(ours, sent));
    REQUIRE(client.meet(partner, sent));
    for (const command_news& each : other.take())
        CHECK_FALSE(std::holds_alternative<order_request>(each));

    const order_outcome outcome{order_result::device_error, 2, "no such register"};
    const auto reply = client.hear(ours, sent.key, outcome);
    REQUIRE(reply);
    CHECK(reply->outcome == outcome);
    CHECK(reply->gateway == "gw");
    CHECK(reply->member == "member-1");
    CHECK(reply->done == noon);

    std::optional<order_reply> heard;
    const auto end = steady::now() + deadline;
    while (!heard && steady::now() < end) {
        ours.reply(sent.key, outcome, noon);
        ::pollfd ready{partner.descriptor(), POLLIN, 0};
        ::poll(&ready, 1, 100);
        for (command_news& each : partner.take())
            if (auto* const news = std::get_if<order_reply>(&each))
                heard = std::move(*news);
    }
    REQUIRE(heard);
    CHECK(heard->key == sent.key);
    CHECK(heard->outcome == outcome);
    for (const command_news& each : ours.take())
        CHECK_FALSE(std::holds_alternative<order_reply>(each));
}

TEST_CASE("dds requests: many at once are taken in parts, and none is lost")
{
    auto gateway = port("gw");
    asker client;
    REQUIRE(client.meet(gateway, request(point_order{"p", {point_kind::integer, 1, 1, ""}}, 1000)));
    for (std::uint64_t i = 0; i < 200; ++i)
        REQUIRE(client.out.send(request(point_order{"p", {point_kind::integer, 1, 1, ""}}, i)));
    std::vector<std::uint64_t> got;
    const auto end = steady::now() + deadline;
    while (got.size() < 200 && steady::now() < end) {
        ::pollfd ready{gateway.descriptor(), POLLIN, 0};
        if (::poll(&ready, 1, 100) <= 0)
            continue;
        const auto news = gateway.take();
        CHECK(news.size() <= 64);
        for (const command_news& each : news)
            if (std::get<order_request>(each).key.request < 200)
                got.push_back(std::get<order_request>(each).key.request);
    }
    REQUIRE(got.size() == 200);
    for (std::uint64_t i = 0; i < 200; ++i)
        CHECK(got[i] == i);
}
