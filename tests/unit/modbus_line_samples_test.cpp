// When a route is published.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

TEST_CASE("modbus line: the first sample of each route says that it was never read")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0, 3), 0, 1s);
    f.line.add_route(f.route_to("M0", table::coils, 0, 17), 0, 1s);
    f.line.start(t0);
    const auto samples = f.line.take_samples(t0);
    REQUIRE(samples.size() == 2);
    for (const sample& each : samples) {
        CHECK(each.state == quality::never_read);
        CHECK(each.source == wall_time::never);
    }
    CHECK(samples[0].words == std::vector<std::uint16_t>(3));
    CHECK(samples[1].words == std::vector<std::uint16_t>(2));
    CHECK(f.line.take_samples(t0).empty());
    CHECK(f.line.take_samples(t0 + 1h).empty());  // nothing new came
}

TEST_CASE("modbus line: a value that is not renewed for three periods is stale, until it is read again")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0, 1), 0, 1s);
    f.line.start(t0);
    f.line.answered(*f.line.next(t0), registers_read{{7}}, t0, noon);
    f.line.take_samples(t0);
    CHECK(f.line.take_samples(t0 + 3s).empty());
    CHECK(f.line.routes_up() == 1);

    const auto aged = f.line.take_samples(t0 + 3s + 1us);
    REQUIRE(aged.size() == 1);
    CHECK(aged[0].state == quality::stale);
    CHECK(aged[0].words == std::vector<std::uint16_t>{7});
    CHECK(aged[0].source == noon);
    CHECK(f.line.routes_up() == 0);
    CHECK(f.line.take_samples(t0 + 1min).empty());

    f.line.answered(*f.line.next(t0 + 1min), registers_read{{7}}, t0 + 1min, noon);
    CHECK(f.line.take_samples(t0 + 1min)[0].state == quality::good);
}

TEST_CASE("modbus line: what is written only on change does not grow stale")
{
    line_fixture f;
    f.line.add_route(f.route_to("M0", table::coils, 0, 1, direction::write), 0, {});
    f.line.start(t0);
    f.set_bit("M0", true);
    f.memory_changed();
    f.line.answered(*f.line.next(t0), written{}, t0, noon);
    f.line.take_samples(t0);
    CHECK(f.line.take_samples(t0 + 1h).empty());
    CHECK(f.line.routes_up() == 1);
}

TEST_CASE("modbus line: whoever is new gets every route once more")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0, 1), 0, 1s);
    f.line.add_route(f.route_to("D200", table::holding_registers, 5, 1), 0, 1s);
    f.line.start(t0);
    CHECK(f.line.take_samples(t0).size() == 2);
    f.line.say_everything();
    CHECK(f.line.take_samples(t0).size() == 2);
    CHECK(f.line.take_samples(t0).empty());
}

TEST_CASE("modbus line: a route is published when its words or quality change, and after the longest silence")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0, 1), 0, 1s);
    f.line.start(t0);
    f.line.take_samples(t0);

    // second: what the answer is (-1: none), and whether a sample follows
    struct {
        int second;
        int answer;
        bool published;
        quality state;
    } const rows[] = {
        {0, 0, true, quality::good},  // the words are as before, the quality is new
        {1, 0, false, {}},
        {2, 5, true, quality::good},
        {3, 5, false, {}},
        {4, -1, true, quality::comm_error},
        {5, 5, true, quality::good},
        {7, 5, false, {}},
        {14, 5, false, {}},
        {15, 5, true, quality::good},  // 10 s after the last one
        {16, 5, false, {}},
        {17, -1, true, quality::comm_error},
        {18, -1, false, {}},
        {58, -1, false, {}},  // nothing to confirm
        {118, 5, true, quality::good},
    };
    for (const auto& row : rows) {
        CAPTURE(row.second);
        const time_point now = t0 + std::chrono::seconds(row.second);
        const auto q = f.line.next(now);
        REQUIRE(q.has_value());
        if (row.answer < 0)
            f.line.failed(*q, errc::timed_out, now);
        else
            f.line.answered(*q, registers_read{{static_cast<std::uint16_t>(row.answer)}}, now,
                            wall_time{row.second + 1});
        const auto samples = f.line.take_samples(now);
        REQUIRE(samples.size() == (row.published ? 1 : 0));
        if (!row.published)
            continue;
        CHECK(samples[0].state == row.state);
        if (row.state == quality::good)
            CHECK(samples[0].source == wall_time{row.second + 1});
    }
}

TEST_SUITE_END();
