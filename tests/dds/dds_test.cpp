// Publisher and subscriber meet in one process, and over the loopback interface with a second one.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "bridge/dds/log.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace plcgw;
using namespace plcgw::test;

namespace {

dds_publisher publisher(const dds_settings& settings = own_domain())
{
    auto out = dds_publisher::create(settings, identity("gw"));
    REQUIRE_MESSAGE(out.has_value(), out.error().text);
    return std::move(*out);
}

dds_subscriber subscriber(const dds_settings& settings = own_domain())
{
    auto in = dds_subscriber::create(settings);
    REQUIRE_MESSAGE(in.has_value(), in.error().text);
    return std::move(*in);
}

auto blocks_at_least(std::size_t count)
{
    return [=](const auto& events) { return only<received_block>(events).size() >= count; };
}

}  // namespace

TEST_CASE("dds: a late subscriber gets the last value of every register at once, and nothing older")
{
    auto out = publisher();
    for (std::uint16_t value = 1; value <= 3; ++value)
        for (unsigned route = 0; route < 50; ++route)
            out.publish(block(route, value));
    sample bits{"bits", "coil", 5, sample_format::bits, 20, {0xFFFF, 0x000F}, quality::never_read, wall_time::never};
    out.publish(bits);
    CHECK(out.drops() == 0);
    CHECK(out.published() == 151);

    auto in = subscriber();
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(51)));
    std::set<std::string> routes;
    for (const auto& e : only<received_block>(events)) {
        routes.insert(e.value.route);
        CHECK(e.gateway == "gw");
        CHECK(e.member == "member-1");
        if (e.value.route == "bits") {
            CHECK(e.value.format == sample_format::bits);
            CHECK(e.value.count == 20);
            CHECK(e.value.words == bits.words);
            CHECK(e.value.state == quality::never_read);
            CHECK(e.value.source == wall_time::never);
            continue;
        }
        CHECK(e.seq == 3);
        CHECK(e.code == 192);
        CHECK(e.value.area == "holding");
        CHECK(e.value.words == std::vector<std::uint16_t>{3, 42});
        CHECK(e.value.source == wall_time{1'700'000'000'000'000'003});
    }
    CHECK(routes.size() == 51);
    CHECK(events.size() == 51);
}

TEST_CASE("dds: every serial message arrives once, with all its bytes and its number")
{
    auto in = subscriber();
    auto out = publisher();
    std::vector<dds_event> events;
    buffer all;
    for (unsigned byte = 0; byte < 4096; ++byte)
        all.push_back(static_cast<std::uint8_t>(byte));
    serial_message message{"scale", message_direction::sent, "ask", "", all, wall_time{17}};
    out.publish(message);
    REQUIRE(collect(in, events, [](const auto& so_far) { return !only<received_message>(so_far).empty(); }));
    for (unsigned i = 0; i < 100; ++i) {
        message.content = {static_cast<std::uint8_t>(i)};
        message.way = message_direction::received;
        message.reason = "no pattern";
        out.publish(message);
    }
    REQUIRE(collect(in, events, [](const auto& so_far) { return only<received_message>(so_far).size() >= 101; }));
    CHECK(out.drops() == 0);
    const auto messages = only<received_message>(events);
    REQUIRE(messages.size() == 101);
    CHECK(messages[0].value.content == all);
    CHECK(messages[0].value.way == message_direction::sent);
    CHECK(messages[0].value.name == "ask");
    for (unsigned i = 0; i < messages.size(); ++i) {
        CHECK(messages[i].gateway == "gw");
        CHECK(messages[i].seq == i + 1);
        CHECK(messages[i].value.line == "scale");
        CHECK(messages[i].value.when == wall_time{17});
        if (i > 0) {
            CHECK(messages[i].value.content == buffer{static_cast<std::uint8_t>(i - 1)});
            CHECK(messages[i].value.reason == "no pattern");
            CHECK(messages[i].value.way == message_direction::received);
        }
    }
    message.content.resize(4097);
    out.publish(message);
    CHECK(out.drops() == 1);
}

TEST_CASE("dds: a change of quality alone arrives")
{
    auto in = subscriber();
    auto out = publisher();
    std::vector<dds_event> events;
    for (const quality q : {quality::good, quality::stale, quality::comm_error, quality::device_error}) {
        events.clear();
        out.publish(block(1, 7, q));
        REQUIRE(collect(in, events, blocks_at_least(1)));
        CHECK(only<received_block>(events)[0].value.state == q);
    }
    CHECK(only<received_block>(events)[0].seq == 4);
}

TEST_CASE("dds: the gateway's status has a beat, and its end is told")
{
    auto in = subscriber();
    std::vector<dds_event> events;
    {
        auto out = publisher();
        const gateway_status status{gateway_role::standby, 5, wall_time{99}, 2, 3};
        out.publish(status);
        REQUIRE(collect(in, events, [](const auto& e) { return !only<received_status>(e).empty(); }));
        const auto first = only<received_status>(events)[0];
        CHECK(first.who == identity("gw"));
        CHECK(first.status == status);
        CHECK(first.beat == 1);

        events.clear();
        out.publish(status);
        out.publish(block(1, 1));
        REQUIRE(collect(in, events, blocks_at_least(1)));
        CHECK(only<received_status>(events).at(0).beat == 2);
        events.clear();
    }
    REQUIRE(collect(in, events, [](const auto& e) { return e.size() >= 2; }));
    const auto gone = only<gone_gateway>(events);
    REQUIRE(gone.size() == 1);
    CHECK(gone[0].gateway == "gw");
    CHECK(gone[0].member == "member-1");
    CHECK(gone[0].reason == gone_reason::writer_lost);
    CHECK(only<gone_block>(events).at(0).route == "route-1");
}

TEST_CASE("dds: a disposed route is gone, and can come back")
{
    auto in = subscriber();
    auto out = publisher();
    out.publish(block(1, 1));
    out.publish(block(2, 1));
    out.dispose(block(3, 1));  // never published: nothing to say
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(2)));
    events.clear();

    out.dispose(block(1, 1));
    REQUIRE(collect(in, events, [](const auto& e) { return !e.empty(); }));
    REQUIRE(only<gone_block>(events).size() == 1);
    CHECK(only<gone_block>(events)[0].route == "route-1");
    CHECK(only<gone_block>(events)[0].reason == gone_reason::disposed);
    events.clear();

    out.publish(block(1, 9));
    REQUIRE(collect(in, events, blocks_at_least(1)));
    CHECK(out.drops() == 0);
}

TEST_CASE("dds: a reader that never takes blocks nobody and keeps only the last")
{
    auto out = publisher();
    for (std::uint16_t i = 0; i < 2000; ++i)
        out.publish(block(i % 50U, i));  // no reader at all
    auto in = subscriber();
    for (std::uint16_t i = 0; i < 2000; ++i)
        out.publish(block(i % 50U, i));
    CHECK(out.drops() == 0);
    CHECK(out.published() == 4000);

    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(50)));
    CHECK(events.size() == 50);
    for (const auto& e : only<received_block>(events))
        CHECK(e.seq == 80);
}

TEST_CASE("dds: many events are taken in portions, and the descriptor says that there are more")
{
    auto out = publisher();
    for (unsigned route = 0; route < 300; ++route)
        out.publish(block(route, 1));
    auto in = subscriber();
    std::size_t taken = in.take(100).size();
    CHECK(taken >= 100);
    CHECK(taken < 300);
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(300 - taken)));
    CHECK(in.take().empty());
}

TEST_CASE("dds: what cannot be written is counted, long names are cut")
{
    auto in = subscriber();
    auto out = publisher();
    sample s = block(1, 1);
    s.words.assign(1025, 0);
    out.publish(s);
    CHECK(out.drops() == 1);
    CHECK(out.last_error() == "Bad Parameter");

    s.words.assign(1024, 5);
    s.route = std::string(63, 'r') + "\u00b5";
    out.publish(s);
    CHECK(out.drops() == 1);
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(1)));
    CHECK(only<received_block>(events)[0].value.route == std::string(63, 'r'));
    CHECK(only<received_block>(events)[0].value.words == s.words);
}

TEST_CASE("dds: partitions are apart")
{
    auto plant = own_domain();
    plant.partition += "-plant";
    auto in = subscriber(plant);
    auto other = publisher();
    auto out = publisher(plant);
    other.publish(block(1, 1));
    out.publish(block(2, 1));
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, blocks_at_least(1)));
    CHECK(only<received_block>(events)[0].value.route == "route-2");
    CHECK(events.size() == 1);
}

TEST_CASE("dds: an interface that does not exist is an error with its reason, and can be tried again")
{
    std::vector<std::string> logged;
    set_dds_log([&](dds_log_level, const std::string& line) { logged.push_back(line); });
    auto settings = own_domain();
    settings.interface = "nosuch0";
    const auto out = dds_publisher::create(settings, identity("gw"));
    REQUIRE_FALSE(out.has_value());
    CAPTURE(out.error().text);
    CHECK(out.error().text.find("interface nosuch0") != std::string::npos);
    CHECK(out.error().text.find("does not match") != std::string::npos);
    CHECK_FALSE(dds_subscriber::create(settings).has_value());
    CHECK(logged.empty());  // the caller logs the error, once
    set_dds_log({});

    auto good = publisher();
    CHECK_FALSE(dds_publisher::create(settings, identity("gw")).has_value());  // one domain, one configuration
}
