// A line over minutes and hours of virtual time: an exchange takes 20 ms, a timeout 500 ms and, with a retry, 1 s.
#include "tests/support/play.hpp"
#include "tests/support/virtual_time.hpp"

#include <set>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

// Some stations with one poll each: item i belongs to station i.
struct bus {
    explicit bus(std::size_t stations) : line(stations), polls(stations), seen(stations) {}

    void add(std::size_t station, duration period) { line.add_poll(station, period); }

    void run(duration how_long)
    {
        const time_point until = now + how_long;
        now = play(line, now, until, [&](const schedule::turn& turn, time_point at) {
            const bool is_probe = line.state_of(turn.item) == health::down;
            const bool is_dead = dead.contains(turn.item);
            const ending e = !is_dead ? answers(20ms) : silent(turn.with_retries ? 1000ms : 500ms);
            if (is_probe) {
                CHECK_FALSE(turn.with_retries);
                probing += e.took;
                ++probes;
            }
            if (!is_dead) {
                ++polls[turn.item];
                seen[turn.item] = at;
            }
            return e;
        });
    }

    double mean_period(std::size_t item, duration in) const
    {
        return std::chrono::duration<double>(in).count() / polls[item];
    }

    schedule line;
    std::set<std::size_t> dead;
    std::vector<int> polls;  // that were answered
    std::vector<time_point> seen;
    duration probing{};
    int probes = 0;
    time_point now = t0;
};

}  // namespace

TEST_CASE("schedule: a line that is not full keeps every period")
{
    bus b(4);
    const duration periods[] = {100ms, 200ms, 500ms, 1s};
    for (std::size_t i = 0; i < 4; ++i)
        b.add(i, periods[i]);
    b.line.start(t0);
    b.run(60s);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(b.polls[i] == 60s / periods[i]);
}

TEST_CASE("schedule: on a line that is too full all periods are stretched by the same factor")
{
    bus b(4);
    for (std::size_t i = 0; i < 3; ++i)
        b.add(i, 40ms);  // 150 % of the line
    b.add(3, 10s);
    b.line.start(t0);
    b.run(10s);
    CHECK(b.line.wanted() == doctest::Approx(1.502).epsilon(0.001));
    CHECK(b.line.stretch() == doctest::Approx(1.502).epsilon(0.001));
    b.polls.assign(4, 0);
    b.run(300s);
    CHECK(b.polls[0] + b.polls[1] + b.polls[2] + b.polls[3] == 15000);  // busy all the time
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(b.mean_period(i, 300s) == doctest::Approx(0.040 * 1.502).epsilon(0.01));
    CHECK(b.mean_period(3, 300s) == doctest::Approx(10 * 1.502).epsilon(0.06));
}

TEST_CASE("schedule: what others take is not there for the polls, and a station that is down wants nothing")
{
    bus b(4);
    for (std::size_t i = 0; i < 4; ++i)
        b.add(i, 60ms);  // 133 %
    b.line.start(t0);
    b.run(10s);
    CHECK(b.line.stretch() == doctest::Approx(4.0 / 3).epsilon(0.01));
    b.dead = {2, 3};  // 67 % remain, and 5 % for probes
    b.run(60s);
    CHECK(b.line.wanted() == doctest::Approx(2.0 / 3).epsilon(0.01));
    CHECK(b.line.stretch() == 1);
    b.polls.assign(4, 0);
    b.run(60s);
    CHECK(b.mean_period(0, 60s) == doctest::Approx(0.060).epsilon(0.02));
}

TEST_CASE("schedule: a station dies, the others keep their pace within 10 %")
{
    for (const duration period : {100ms, 250ms, 1000ms}) {
        CAPTURE(period);
        bus b(4);
        for (std::size_t i = 0; i < 4; ++i)
            b.add(i, period);
        b.line.start(t0);
        b.run(10s);
        REQUIRE(b.polls == std::vector<int>(4, static_cast<int>(10s / period)));

        b.dead.insert(2);
        b.polls.assign(4, 0);
        b.run(60s);
        CHECK(b.line.state_of(2) == health::down);
        const double wanted = std::chrono::duration<double>(period).count();
        for (const std::size_t alive : {0, 1, 3})
            CHECK(b.mean_period(alive, 60s) <= 1.1 * wanted);
        CHECK(b.polls[2] == 0);
    }
}

TEST_CASE("schedule: five dead stations are probed for at most 5 % of an hour")
{
    bus b(8);
    for (std::size_t i = 0; i < 8; ++i)
        b.add(i, 200ms);
    b.line.start(t0);
    b.run(10s);
    b.dead = {1, 2, 3, 5, 7};
    b.polls.assign(8, 0);
    b.run(1h);
    CHECK(b.probing <= 3min + 500ms);
    CHECK(b.probes >= 5 * 60);  // and each of them about once a minute
    for (const std::size_t alive : {0, 4, 6})
        CHECK(b.mean_period(alive, 1h) <= 1.1 * 0.2);
}

TEST_CASE("schedule: probes come through on a line that is full")
{
    bus b(3);
    for (std::size_t i = 0; i < 3; ++i)
        b.add(i, 30ms);
    b.line.start(t0);
    b.dead = {1};
    b.run(10min);
    CHECK(b.probes >= 18);
    CHECK(b.probing <= 30s + 500ms);
    b.dead.clear();
    b.run(31s);
    CHECK(b.line.state_of(1) == health::healthy);
}

TEST_CASE("schedule: a station that comes back is noticed within the probe interval")
{
    for (const duration away : {5s, 30s, 120s, 600s, 3600s}) {
        CAPTURE(away);
        bus b(4);
        for (std::size_t i = 0; i < 4; ++i)
            b.add(i, 200ms);
        b.line.start(t0);
        b.dead = {3};
        b.run(away);
        b.dead.clear();
        const time_point back = b.now;
        while (b.line.state_of(3) != health::healthy && b.now < back + 1h)
            b.run(100ms);
        CHECK(b.now - back <= 30s + 600ms);

        b.polls.assign(4, 0);
        b.run(10s);
        CHECK(b.polls[3] >= 49);  // at its old pace
        CHECK(b.polls[3] <= 51);  // and not more: what was missed is skipped
    }
}

TEST_CASE("schedule: five stations that come back together are all noticed within a round of probes")
{
    bus b(5);
    for (std::size_t i = 0; i < 5; ++i)
        b.add(i, 200ms);
    b.line.start(t0);
    b.dead = {0, 1, 2, 3, 4};
    b.run(30min);
    b.dead.clear();
    b.run(30s + 10s);  // the interval, and the pause that the last failed probe left
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(b.line.state_of(i) == health::healthy);
}

TEST_SUITE_END();
