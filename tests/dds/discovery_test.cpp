// Who is seen in a domain, whether they meet us, and a domain that is made anew.
#include "bridge/dds/discovery.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace plcgw;
using namespace plcgw::test;

namespace {

dds_discovery discovery(const dds_settings& settings = own_domain())
{
    auto made = dds_discovery::create(settings);
    REQUIRE_MESSAGE(made.has_value(), made.error().text);
    return std::move(*made);
}

// The endpoint of the other process, once it is seen.
std::optional<seen_endpoint> wait_for(dds_discovery& in, dds_topic topic, bool writes)
{
    const auto end = steady::now() + deadline;
    while (steady::now() < end) {
        for (const seen_participant& each : in.look())
            for (const seen_endpoint& endpoint : each.endpoints)
                if (endpoint.topic == topic && endpoint.writes == writes)
                    return endpoint;
        ::poll(nullptr, 0, 10);
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE("partitions: equal names, and patterns of one side")
{
    CHECK(partition_matches("", ""));
    CHECK(partition_matches("plant1", "plant1"));
    CHECK_FALSE(partition_matches("plant1", "plant2"));
    CHECK_FALSE(partition_matches("plant1", ""));
    CHECK(partition_matches("plant*", "plant1"));
    CHECK(partition_matches("plant1", "plant?"));
    CHECK_FALSE(partition_matches("plant*", "planet1"));
    CHECK_FALSE(partition_matches("plant*", "pl*"));  // two patterns
}

TEST_CASE("discovery: another process is seen with its topics, and where it runs")
{
    auto in = discovery();
    CHECK(in.look().empty());
    peer_process gateway({"publish", place(), "other", "1"});
    REQUIRE(gateway.line() == "ready");
    const auto port = wait_for(in, dds_topic::port_status, true);
    REQUIRE(port.has_value());
    CHECK(port->same_partition);
    CHECK(port->refusals.empty());
    const auto seen = in.look();
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].process.find("dds_peer") != std::string::npos);
    CHECK_FALSE(seen[0].host.empty());
    CHECK(seen[0].addresses.find("127.0.0.1") != std::string::npos);
}

TEST_CASE("discovery: a foreign partition and another reliability are told")
{
    peer_process gateway({"publish", place(), "other", "1"});
    REQUIRE(gateway.line() == "ready");
    peer_process reader({"watch", place(), "json", "0", "0"});
    auto settings = own_domain();
    settings.partition += "-foreign";
    {
        auto foreign = discovery(settings);
        const auto writer = wait_for(foreign, dds_topic::register_block, true);
        REQUIRE(writer.has_value());
        CHECK_FALSE(writer->same_partition);
        CHECK(writer->partitions == std::vector<std::string>{own_domain().partition});
    }
    settings = own_domain();
    settings.topic(dds_topic::point).reliability = dds_reliability::best_effort;
    auto in = discovery(settings);
    const auto met = wait_for(in, dds_topic::point, false);
    REQUIRE(met.has_value());
    CHECK(met->same_partition);
    CHECK(met->refusals == std::vector<std::string>{"reliability"});
    const auto other = wait_for(in, dds_topic::event, false);
    REQUIRE(other.has_value());
    CHECK(other->refusals.empty());
}

TEST_CASE("dds: when all have closed a domain, the next one is new, and its readers get everything again")
{
    peer_process watch({"watch", place(), "json", "0", "0"});
    const auto publish_all = [](dds_publisher& out) {
        out.publish(block(1, 1));
        out.publish(port_status{"bus", link_state::up, wall_time{1}, 0, 0, 0, 0, 0, 0, ""});
    };
    const auto next_of = [&](const std::string& what) {
        std::string line;
        do
            line = watch.line();
        while (!line.empty() && line.find(what) == std::string::npos);
        return line;
    };
    auto settings = own_domain();
    for (unsigned round = 0; round < 2; ++round) {
        settings.lease += 1ms * round;  // other settings are refused while the old domain lives
        auto out = dds_publisher::create(settings, identity("gw"));
        REQUIRE_MESSAGE(out.has_value(), out.error().text);
        publish_all(*out);
        CHECK_FALSE(next_of("\"port\":\"bus\"").empty());
    }
}
