#include "bridge/routes/health.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

TEST_CASE("health: one failure makes a station suspect, an answer heals it")
{
    station_health h;
    CHECK(h.state() == health::healthy);
    h.failed(t0);
    CHECK(h.state() == health::suspect);
    h.answered();
    CHECK(h.state() == health::healthy);
    h.failed(t0);
    CHECK(h.state() == health::suspect);  // it begins anew
}

TEST_CASE("health: two failures take it down, probes come after at most 1, 2, 4, 8, 16, then every 30 s")
{
    station_health h;
    h.failed(t0);
    time_point now = t0;
    for (const auto interval : {1s, 2s, 4s, 8s, 16s, 30s, 30s, 30s}) {
        now += 500ms;
        h.failed(now);
        CHECK(h.state() == health::down);
        CHECK(h.probe_at() <= now + interval);
        CHECK(h.probe_at() > now + interval * 8 / 10);
        now = h.probe_at();
    }
    h.answered();
    CHECK(h.state() == health::healthy);
    h.failed(now);
    h.failed(now);
    CHECK(h.probe_at() <= now + 1s);
}

TEST_CASE("health: stations that went down together are probed at different times")
{
    station_health first(1);
    station_health second(2);
    for (station_health* each : {&first, &second}) {
        each->failed(t0);
        each->failed(t0);
    }
    CHECK(first.probe_at() != second.probe_at());
}

TEST_CASE("health: somebody else's silence makes a healthy station suspect, and no more")
{
    station_health h;
    h.doubted();
    CHECK(h.state() == health::suspect);
    h.doubted();
    CHECK(h.state() == health::suspect);
    h.answered();
    CHECK(h.state() == health::healthy);
}

TEST_CASE("health: names")
{
    CHECK(to_string(health::healthy) == "healthy");
    CHECK(to_string(health::suspect) == "suspect");
    CHECK(to_string(health::down) == "down");
}

TEST_SUITE_END();
