// Where a gateway is heard, and the QoS of its topics: what is safe, and why the rest is not.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw;
using namespace plcgw::config;
using namespace std::chrono_literals;

namespace {

std::string with(const std::string& dds) { return "{\n\"dds\": {" + dds + "}}"; }

}  // namespace

TEST_CASE("check: QoS of topics")
{
    const struct {
        const char* dds;
        const char* expected;
    } rows[] = {
        {R"("topics": {"point": {"enabled": false}, "event": {"depth": 1000, "reliability": "best-effort"}})", ""},
        {R"("topics": {"register_block": {"deadline_ms": 1001}, "port_status": {"deadline_ms": 20000}})", ""},
        {R"("topics": {"register_block": {"history": "keep-last", "extensibility": "final"}})", ""},
        {R"("topics": {"event": {"history": "keep-all"}})",
         "2 /dds/topics/event/history is \"keep-all\", which is not safe: one reader that does not take its samples "
         "would hold up the gateway, for everybody. Take keep-last, with a depth of events that suits your readers"},
        {R"("topics": {"point": {"extensibility": "appendable"}})",
         "2 /dds/topics/point/extensibility is \"appendable\", which is not safe: Cyclone DDS sends it as XCDR2 only, "
         "which Fast DDS 2.x cannot read: such readers would match and get nothing. The types are final, and a new one "
         "gets new topic names"},
        {R"("topics": {"point": {"history": "keep-some"}})",
         R"(2 /dds/topics/point/history is "keep-some", expected one of: keep-last)"},
        {R"("topics": {"register_block": {"deadline_ms": 1000}})",
         "2 /dds/topics/register_block/deadline_ms is 1000, but an unchanged sample comes again after 1000 ms "
         "(longest_silence_ms, or period_ms of a route) only: at least 1001"},
        {R"("topics": {"device_status": {"deadline_ms": 5000}})",
         "2 /dds/topics/device_status/deadline_ms is 5000, but an unchanged sample comes again after 10000 ms "
         "(status_silence_ms) only: at least 10001"},
        {R"("topics": {"events": {}})", R"(2 /dds/topics/events is no known key: did you mean "event"?)"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.dds);
        CHECK(said(with(row.dds)) == row.expected);
    }
    // Of a state the last sample is kept, no more.
    CHECK(said(with(R"("topics": {"point": {"depth": 3}})")).starts_with("2 /dds/topics/point/depth is no known key"));
}

TEST_CASE("check: what was set of topics is what the publisher gets")
{
    const auto loaded = load_text(with(R"("topics": {"point": {"deadline_ms": 2000},
        "port_status": {"enabled": false}, "event": {"depth": 7, "reliability": "best-effort"}})"),
                                  {});
    const dds_settings& s = loaded.config.dds.settings;
    CHECK(s.topic(dds_topic::point).deadline == 2s);
    CHECK(s.topic(dds_topic::point).enabled);
    CHECK_FALSE(s.topic(dds_topic::port_status).enabled);
    CHECK(s.topic(dds_topic::event).history == 7);
    CHECK(s.topic(dds_topic::event).reliability == dds_reliability::best_effort);
    CHECK(s.topic(dds_topic::register_block) == topic_settings{});
    CHECK(s.topic(dds_topic::device_status) == topic_settings{});
    CHECK(s.topic(dds_topic::gateway_status) == topic_settings{});
    CHECK(s.topic(dds_topic::serial_message) == topic_settings{});
}

TEST_CASE("check: partitions have names, the file of Cyclone DDS exists")
{
    CHECK(said(with(R"("partition": "plant1", "partitions": ["plant2", "north/plant3"], "lease_ms": 2000)")) == "");
    CHECK(said(with(R"("partition": "plant*")")) ==
          "2 /dds/partition is \"plant*\": a pattern is for readers (`plc-gateway watch --partition 'plant*'`), the "
          "gateway publishes in partitions that have names");
    CHECK(said(with(R"("partitions": ["a", "b?"])")).starts_with("2 /dds/partitions/1 is \"b?\": a pattern"));
    CHECK(said(with(R"("lease_ms": 100)")) == "2 /dds/lease_ms is 100, expected a whole number from 500 to 3600000");

    const auto folder = std::filesystem::temp_directory_path() / ("plcgw-dds-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "cyclone.xml") << "<CycloneDDS/>";
    CHECK(said(with(R"("cyclone_config": "cyclone.xml")"), folder) == "");
    CHECK(said(with(R"("cyclone_config": "cyclone.xml", "peers": ["10.0.0.1"])"), folder) ==
          "2 warning /dds/peers are not used: /dds/cyclone_config says all of where the gateway is heard, its peers, "
          "too");
    CHECK(said(with(R"("cyclone_config": "nowhere.xml")"), folder) ==
          "2 /dds/cyclone_config is \"" + (folder / "nowhere.xml").string() +
              "\", which cannot be found: a path is relative to the folder of this configuration");
    CHECK(load_text(with(R"("cyclone_config": "cyclone.xml")"), folder).config.dds.settings.cyclone_config ==
          (folder / "cyclone.xml").string());
    std::filesystem::remove_all(folder);
}

TEST_CASE("check: a deadline is not shorter than the slowest point or read")
{
    const std::string text =
        with(R"("topics": {"point": {"deadline_ms": 5000}, "register_block": {"deadline_ms": 1500}})");
    const auto site = [&](const std::string& more) { return text.substr(0, text.size() - 1) + ",\n" + more + "}"; };
    const std::string plc = R"("plcs": [{"name": "p"}],)";
    CHECK(said(site(plc + R"("points": [{"name": "a", "plc": "p", "device": "D1", "longest_silence_ms": 4999}])")) ==
          "");
    CHECK(said(site(plc + R"("points": [{"name": "a", "plc": "p", "device": "D1", "longest_silence_ms": 5000}])")) ==
          "2 /dds/topics/point/deadline_ms is 5000, but an unchanged sample comes again after 5000 ms "
          "(longest_silence_ms of a point) only: at least 5001");
    CHECK(
        said(site(plc + R"("points": [{"name": "a", "plc": "p", "device": "D1", "longest_silence_ms": 0}])")) ==
        "2 /dds/topics/point/deadline_ms cannot be kept: point a has longest_silence_ms 0, so that it comes only when "
        "it changes");
    CHECK(said(site(plc + R"("lines": [{"name": "l", "device": "/dev/ttyS0"}],
"stations": [{"name": "s", "line": "l", "unit": 1}],
"routes": [{"name": "r", "station": "s", "table": "input", "first": 0, "plc": "p", "device": "D1", "period_ms": 2000}])")) ==
          "2 /dds/topics/register_block/deadline_ms is 1500, but an unchanged sample comes again after 2000 ms "
          "(longest_silence_ms, or period_ms of a route) only: at least 2001");
}
