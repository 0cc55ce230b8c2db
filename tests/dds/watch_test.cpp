// `plc-gateway watch` and a gateway as processes of their own, over the loopback interface.
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace plcgw;
using namespace plcgw::test;

namespace {

dds_publisher publisher()
{
    auto out = dds_publisher::create(own_domain(), identity("gw"));
    REQUIRE_MESSAGE(out.has_value(), out.error().text);
    return std::move(*out);
}

}  // namespace

TEST_CASE("watch: --json --count prints one object per sample and ends")
{
    auto out = publisher();
    out.publish(
        sample{"speed", "coil", 16, sample_format::bits, 3, {5}, quality::stale, wall_time{1'700'000'000'123'456'789}});
    out.publish(block(1, 1));
    peer_process watch({"watch", place(), "json", "1", "0", "spe"});
    const auto line = watch.line();
    CAPTURE(line);
    const auto object = nlohmann::json::parse(line);
    CHECK(object["event"] == "registers");
    CHECK(object["gateway"] == "gw");
    CHECK(object["member"] == "member-1");
    CHECK(object["route"] == "speed");
    CHECK(object["area"] == "coil");
    CHECK(object["first"] == 16);
    CHECK(object["format"] == "bits");
    CHECK(object["count"] == 3);
    CHECK(object["values"] == nlohmann::json{1, 0, 1});
    CHECK(object["quality"] == "stale");
    CHECK(object["quality_code"] == 68);
    CHECK(object["source_time"] == "2023-11-14T22:13:20.123Z");
    CHECK(object["source_ns"] == 1'700'000'000'123'456'789);
    CHECK(object["seq"] == 1);
    CHECK(watch.line().empty());
    CHECK(watch.wait() == 0);
}

TEST_CASE("watch: lines for people, and Ctrl-C ends it")
{
    auto out = publisher();
    out.publish(block(1, 1));
    peer_process watch({"watch", place(), "lines", "0", "0"});
    CHECK(watch.line() == "2023-11-14T22:13:20.000Z gw route-1 holding 10..11 good: 1 42");
    watch.signal(SIGINT);
    CHECK(watch.wait() == 0);
}

TEST_CASE("watch: nothing heard until the timeout is exit code 1")
{
    peer_process watch({"watch", place(), "json", "0", "200"});
    CHECK(watch.line().empty());
    CHECK(watch.wait() == 1);
}

TEST_CASE("dds: a stopped subscriber process blocks nobody")
{
    auto out = publisher();
    out.publish(block(1, 0));
    peer_process watch({"watch", place(), "json", "0", "0"});
    REQUIRE_FALSE(watch.line().empty());
    watch.signal(SIGSTOP);
    for (std::uint16_t i = 0; i < 2000; ++i)
        out.publish(block(i % 50U, i));
    CHECK(out.drops() == 0);
}

TEST_CASE("dds: values of another process arrive late but at once, and its end is told")
{
    peer_process gateway({"publish", place(), "other", "50"});
    REQUIRE(gateway.line() == "ready");
    auto in = dds_subscriber::create(own_domain());
    REQUIRE(in.has_value());
    std::vector<dds_event> events;
    REQUIRE(collect(*in, events, [](const auto& e) { return e.size() >= 51; }));
    std::set<std::string> routes;
    for (const auto& e : only<received_block>(events))
        routes.insert(e.value.route);
    CHECK(routes.size() == 50);

    events.clear();
    gateway.close_input();
    CHECK(gateway.wait() == 0);
    REQUIRE(collect(*in, events, [](const auto& e) { return e.size() >= 51; }));
    CHECK(only<gone_block>(events).size() == 50);
    CHECK(only<gone_gateway>(events).size() == 1);
}
