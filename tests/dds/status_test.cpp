// Ports, devices and events over DDS; every state topic for who comes late; what is disposed of.
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

using namespace plcgw;
using namespace plcgw::test;

namespace {

const port_status port{"bus", link_state::up, wall_time{11}, 1, 2, 3, 4, 5, 6, "bad checksum"};
const device_status device{"pump", "bus", link_state::degraded, wall_time{12}, wall_time{13}, 7, 8, 9, 10, 11, "slow"};
const line_event event{line_event::severity::warning, "device.down", "pump", "line bus, station pump is silent"};

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

point_sample temperature(const char* name, double value)
{
    point_sample p;
    p.name = name;
    p.value = {point_kind::real, value, static_cast<std::int64_t>(value), ""};
    p.state = quality::good;
    p.source = wall_time{14};
    return p;
}

template <class Event>
auto has(std::size_t count = 1)
{
    return [=](const auto& events) { return only<Event>(events).size() >= count; };
}

}  // namespace

TEST_CASE("dds: who comes late gets the last value of every state topic, and no old event")
{
    auto out = publisher();
    for (std::uint16_t i = 1; i <= 3; ++i) {
        port_status p = port;
        p.rx_frames = i;
        device_status d = device;
        d.requests = i;
        out.publish(p);
        out.publish(d);
        out.publish(block(1, i));
        out.publish(temperature("temp", i));
        out.publish(gateway_status{gateway_role::solo, 0, wall_time{1}, i, 3});
        out.publish(event, wall_time{i});
    }
    CHECK(out.drops() == 0);
    auto in = subscriber();
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, [](const auto& e) { return e.size() >= 5; }));
    out.publish(event, wall_time{99});  // behind it nothing older can come
    REQUIRE(collect(in, events, has<received_event>()));
    REQUIRE(events.size() == 6);

    port_status last_port = port;
    last_port.rx_frames = 3;
    device_status last_device = device;
    last_device.requests = 3;
    CHECK(only<received_port>(events).at(0).status == last_port);
    CHECK(only<received_port>(events).at(0).gateway == "gw");
    CHECK(only<received_port>(events).at(0).member == "member-1");
    CHECK(only<received_device>(events).at(0).status == last_device);
    CHECK(only<received_block>(events).at(0).seq == 3);
    CHECK(only<received_point>(events).at(0).value.real == 3);
    CHECK(only<received_status>(events).at(0).status.routes_up == 3);
    const auto said = only<received_event>(events).at(0);
    CHECK(said.id == 4);
    CHECK(said.when == wall_time{99});
    CHECK(said.level == line_event::severity::warning);
    CHECK(said.code == "device.down");
    CHECK(said.subject == "pump");
    CHECK(said.text == event.text);
}

TEST_CASE("dds: what is disposed of is gone from every state topic, for a late reader, too")
{
    auto out = publisher();
    auto in = subscriber();
    out.publish(port);
    out.publish(device);
    out.publish(block(1, 1));
    out.publish(temperature("temp", 1));
    out.publish(gateway_status{});
    std::vector<dds_event> events;
    REQUIRE(collect(in, events, [](const auto& e) { return e.size() >= 5; }));
    events.clear();

    out.dispose(port);
    out.dispose(device);
    out.dispose(block(1, 1));
    out.dispose(temperature("temp", 1));
    out.dispose_gateway();
    REQUIRE(collect(in, events, [](const auto& e) { return e.size() >= 5; }));
    CHECK(only<gone_port>(events).at(0).port == "bus");
    CHECK(only<gone_device>(events).at(0).device == "pump");
    CHECK(only<gone_block>(events).at(0).route == "route-1");
    CHECK(only<gone_point>(events).at(0).name == "temp");
    CHECK(only<gone_gateway>(events).at(0).member == "member-1");
    CHECK(only<gone_port>(events).at(0).reason == gone_reason::disposed);
    CHECK(only<gone_device>(events).at(0).reason == gone_reason::disposed);
    CHECK(only<gone_gateway>(events).at(0).reason == gone_reason::disposed);
    CHECK(out.drops() == 0);

    auto late = subscriber();
    out.publish(block(2, 1));
    events.clear();
    REQUIRE(collect(late, events, has<received_block>()));
    CHECK(events.size() == 1);
}

TEST_CASE("dds: ten thousand instances and a subscriber that is stopped: nothing waits, nothing is dropped")
{
    auto out = publisher();
    out.publish(block(1, 0));
    peer_process watch({"watch", place(), "json", "0", "0"});
    REQUIRE_FALSE(watch.line().empty());
    watch.signal(SIGSTOP);
    auto longest = steady::duration::zero();
    device_status each = device;
    for (unsigned round = 0; round < 3; ++round)
        for (unsigned i = 0; i < 10'000; ++i) {
            each.device = "device-" + std::to_string(i);
            each.requests = round;
            const auto began = steady::now();
            out.publish(each);
            out.publish(event, wall_time{i});
            longest = std::max(longest, steady::now() - began);
        }
    CHECK(out.drops() == 0);
    MESSAGE("longest: " << std::chrono::duration_cast<std::chrono::microseconds>(longest).count() << " us");
    CHECK(longest < 5s);  // a write that waits takes until the lease of the stopped one runs out

    auto late = subscriber();
    std::vector<dds_event> events;
    REQUIRE(collect(late, events, has<received_device>(10'000)));
    for (const auto& got : only<received_device>(events))
        CHECK(got.status.requests == 2);
}

TEST_CASE("dds: a topic can be switched off, and be best effort for readers that want no more")
{
    auto settings = own_domain();
    settings.topic(dds_topic::port_status).enabled = false;
    settings.topic(dds_topic::device_status).reliability = dds_reliability::best_effort;
    settings.topic(dds_topic::gateway_status).deadline = 3s;
    auto out = publisher(settings);
    auto careful = subscriber();
    auto content = subscriber(settings);
    std::vector<dds_event> events;
    // Best effort reaches who is there already: until they have met.
    const auto end = steady::now() + deadline;
    while (only<received_device>(events).empty() && steady::now() < end) {
        out.publish(device);
        for (auto& each : content.take())
            events.push_back(std::move(each));
        ::poll(nullptr, 0, 10);
    }
    CHECK(only<received_device>(events).size() > 0);
    out.publish(port);
    out.publish(block(1, 1));
    CHECK(out.drops() == 0);
    std::vector<dds_event> heard;
    REQUIRE(collect(careful, heard, has<received_block>()));
    CHECK(only<received_device>(heard).empty());
    CHECK(only<received_port>(heard).empty());
    const auto refusals = out.take_refusals();
    REQUIRE(refusals.size() == 1);
    CHECK(refusals[0] == "a reader of plcgw/v1/DeviceStatus asks for another reliability");
    CHECK(out.take_refusals().empty());
}

TEST_CASE("dds: several partitions are published in, a pattern reads them")
{
    auto settings = own_domain();
    const std::string base = settings.partition;
    settings.partition = base + "-north";
    settings.partitions = {base + "-south"};
    auto out = publisher(settings);
    out.publish(port);
    for (const std::string& name : {base + "-north", base + "-south", base + "-*"}) {
        CAPTURE(name);
        auto wanted = own_domain();
        wanted.partition = name;
        auto in = subscriber(wanted);
        std::vector<dds_event> events;
        CHECK(collect(in, events, has<received_port>()));
    }
}
