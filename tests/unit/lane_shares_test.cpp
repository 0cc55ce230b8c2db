// Which lane a line serves next, in virtual time: each exchange takes 10 ms.
#include "tests/support/play.hpp"
#include "tests/support/virtual_time.hpp"

#include <array>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr duration exchange = 10ms;

// A line on which everything that is switched on waits all the time.
struct full_line {
    full_line()
    {
        poll = line.add_poll(0, 10ms);
        line.add_poll(1, 10ms);
        write = line.add_write(0);
        line.start(t0);
    }

    // Thousandths of the time that went to each lane.
    std::array<int, lane_count> share(bool writes, bool forwards, bool dead, duration how_long = 100s)
    {
        std::array<duration, lane_count> used{};
        for (const time_point until = now + how_long; now < until;) {
            if (writes)
                line.ask(write);
            const auto turn = line.next(now, forwards);
            if (!turn) {
                now = std::max(now + 1us, line.wake_at(now));
                continue;
            }
            const bool is_silent = dead && turn->of != lane::forward && turn->item == 1;
            const duration took = is_silent ? 200ms : exchange;
            now += took;
            used[static_cast<std::size_t>(turn->of)] += took;
            const auto how = is_silent ? schedule::outcome::silent : schedule::outcome::answered;
            if (turn->of == lane::forward)
                line.forwarded(0, how, took, now, {}, {});
            else
                line.finished(*turn, how, took, now);
        }
        std::array<int, lane_count> shares{};
        for (std::size_t i = 0; i < lane_count; ++i)
            shares[i] = static_cast<int>(used[i] * 1000 / how_long);
        return shares;
    }

    schedule line{2};
    std::size_t poll{};
    std::size_t write{};
    time_point now = t0;
};

bool is_near(int a, int b) { return std::abs(a - b) <= 15; }

}  // namespace

TEST_CASE("lanes: each has its share when all others wait, and what is left when they do not")
{
    struct row {
        bool writes, forwards;
        std::array<int, lane_count> expected;
    };
    const row rows[] = {
        {false, false, {0, 0, 1000, 0}},
        {true, false, {500, 0, 500, 0}},
        {false, true, {0, 250, 750, 0}},  // of 300: a transaction is whole
        {true, true, {500, 250, 250, 0}},
    };
    for (const row& each : rows) {
        CAPTURE(each.writes);
        CAPTURE(each.forwards);
        full_line f;
        const auto got = f.share(each.writes, each.forwards, false);
        for (std::size_t i = 0; i < lane_count; ++i) {
            CAPTURE(i);
            CAPTURE(got[i]);
            CHECK(is_near(got[i], each.expected[i]));
        }
    }
}

TEST_CASE("lanes: probes come through on a full line, and never take more than a twentieth")
{
    full_line f;
    f.share(true, true, true, 10s);
    const auto got = f.share(true, true, true, 1000s);
    CHECK(got[3] <= 50);
    CHECK(got[3] >= 5);  // one of 200 ms each 30 s
}

TEST_CASE("lanes: a lane that had an idle line for itself is not shut out for long when others come")
{
    schedule alone(2);
    time_point now = t0;
    for (int i = 0; i < 6000; ++i) {  // a minute of forwarded requests
        REQUIRE(alone.next(now, true)->of == lane::forward);
        now += exchange;
        alone.forwarded(0, schedule::outcome::answered, exchange, now, {}, {});
    }
    alone.add_poll(1, 10ms);
    const time_point began = now;
    while (true) {
        const auto turn = alone.next(now, true);
        REQUIRE(turn.has_value());
        if (turn->of == lane::forward)
            break;
        now += exchange;
        alone.finished(*turn, schedule::outcome::answered, exchange, now);
    }
    CHECK(now - began <= 2s);
}

TEST_CASE("lanes: a write waits for the exchange under way and at most one other, however full the line is")
{
    full_line f;
    for (int i = 0; i < 500; ++i) {
        f.share(false, true, false, 1s);
        f.line.ask(f.write);
        const auto turn = f.line.next(f.now, true);
        REQUIRE(turn.has_value());
        CHECK(turn->of == lane::write);
        f.now += exchange;
        f.line.finished(*turn, schedule::outcome::answered, exchange, f.now);
    }
}

TEST_SUITE_END();
