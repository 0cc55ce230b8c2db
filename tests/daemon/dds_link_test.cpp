// What the gateway says of its DDS side: drops, readers that do not match, parts that close with the domain.
#include "bridge/dds/subscriber.hpp"
#include "daemon/dds_link.hpp"
#include "daemon/line_events.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <thread>
#include <unistd.h>

TEST_SUITE_BEGIN("dds");

using namespace plcgw;
using namespace std::chrono_literals;

namespace {

struct heard_events {
    heard_events()
    {
        set_event_sink([this](const line_event& event) { all.push_back(event); });
    }
    ~heard_events() { set_event_sink({}); }
    heard_events(const heard_events&) = delete;
    heard_events& operator=(const heard_events&) = delete;

    std::size_t count(std::string_view code) const
    {
        return static_cast<std::size_t>(
            std::ranges::count_if(all, [&](const line_event& each) { return each.code == code; }));
    }

    std::vector<line_event> all;
};

gateway_config config()
{
    gateway_config made;
    made.gateway = "gw";
    made.dds.settings.domain = 46;
    made.dds.settings.partition = "dds-link-" + std::to_string(::getpid());
    return made;
}

const sample too_long{"route",       "holding",   0, sample_format::words, 2000, std::vector<std::uint16_t>(2000),
                      quality::good, wall_time{1}};

}  // namespace

TEST_CASE("dds link: drops are counted at once, and said at most once a minute")
{
    boost::asio::io_context loop;
    dds_link link(loop, config(), "hash");
    heard_events heard;  // in place of the link's own sink
    CHECK(link.port().state == link_state::starting);
    REQUIRE(link.open());
    CHECK(link.is_open());
    CHECK(heard.count("dds.open") == 1);
    CHECK_FALSE(link.open());
    CHECK(link.port().state == link_state::up);
    CHECK(link.port().errors == 0);

    link.publish(too_long);
    CHECK_FALSE(link.open());
    CHECK(link.port().errors == 1);
    CHECK(link.port().detail == "Bad Parameter");
    REQUIRE(heard.count("dds.drops") == 1);
    CHECK(heard.all.back().level == line_event::severity::warning);
    for (unsigned second = 1; second < 60; ++second) {
        link.publish(too_long);
        link.open();
        CHECK(link.port().errors == 1 + second);
        CHECK(heard.count("dds.drops") == 1);
    }
    link.open();
    CHECK(heard.count("dds.drops") == 2);
    CHECK(heard.all.back().text.find("59 samples could not be written, 60 since the start") != std::string::npos);
}

TEST_CASE("dds link: a reader that asks for more than is offered is said once")
{
    boost::asio::io_context loop;
    gateway_config offered = config();
    offered.dds.settings.topic(dds_topic::point).reliability = dds_reliability::best_effort;
    dds_link link(loop, offered, "hash");
    heard_events heard;
    REQUIRE(link.open());
    const auto reader = dds_subscriber::create(config().dds.settings);
    REQUIRE(reader.has_value());
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (heard.count("dds.incompatible") == 0 && std::chrono::steady_clock::now() < end) {
        link.open();
        std::this_thread::sleep_for(10ms);
    }
    REQUIRE(heard.count("dds.incompatible") == 1);
    CHECK(heard.all.back().text.find("plcgw/v1/Point asks for another reliability") != std::string::npos);
    link.open();
    CHECK(heard.count("dds.incompatible") == 1);
}

TEST_CASE("dds link: a missing interface is said once, and tried again")
{
    boost::asio::io_context loop;
    gateway_config missing = config();
    missing.dds.settings.interface = "nosuch0";
    dds_link link(loop, missing, "hash");
    heard_events heard;
    for (unsigned second = 0; second < 5; ++second)
        CHECK_FALSE(link.open());
    CHECK(heard.count("dds.failed") == 1);
    CHECK(link.port().state == link_state::down);
    CHECK(link.port().detail.find("nosuch0") != std::string::npos);
    link.publish(too_long);  // nobody is there
    CHECK(link.port().errors == 0);
}

TEST_CASE("dds link: switched off, it does nothing and says so")
{
    boost::asio::io_context loop;
    gateway_config off = config();
    off.dds.settings.enabled = false;
    dds_link link(loop, off, "hash");
    CHECK_FALSE(link.open());
    CHECK(link.port().state == link_state::disabled);
}
