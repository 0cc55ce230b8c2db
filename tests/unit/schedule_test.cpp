// What a line does next, turn by turn.
#include "tests/support/play.hpp"
#include "tests/support/virtual_time.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

TEST_CASE("schedule: nothing to do")
{
    schedule empty(0);
    empty.start(t0);
    CHECK_FALSE(empty.next(t0).has_value());
    CHECK(empty.wake_at(t0) > t0);

    schedule s(1);
    s.add_poll(0, 1s);
    s.add_write(0);
    s.start(t0);
    time_point now = t0;
    CHECK(next_turns(s, now, 5) == turns{0});
    CHECK(s.wake_at(now) == t0 + 1s);
}

TEST_CASE("schedule: a late line asks by deadline, not by due time")
{
    schedule s(3);
    s.add_poll(0, 3s);     // due at 0 s, deadline 3 s
    s.add_poll(1, 600ms);  // 0.2 s, 0.8 s
    s.add_poll(2, 900ms);  // 0.6 s, 1.5 s
    s.start(t0);
    time_point now = t0 + 610ms;
    CHECK(next_turns(s, now, 3) == turns{1, 2, 0});
}

TEST_CASE("schedule: the first polls are spread over the period")
{
    schedule s(1);
    for (int i = 0; i < 10; ++i)
        s.add_poll(0, 1s);
    s.start(t0);
    play(s, t0, t0 + 3s, [&](const schedule::turn& turn, time_point now) {
        CHECK((now - t0) % 1s == turn.item * 100ms);
        return answers(5ms);
    });
}

TEST_CASE("schedule: a poll keeps its phase, whatever an exchange takes")
{
    schedule s(1);
    s.add_poll(0, 100ms);
    s.start(t0);
    int count = 0;
    play(s, t0, t0 + 10s, [&](const schedule::turn&, time_point now) {
        CHECK(now == t0 + count++ * 100ms);
        return answers(count % 3 * 30ms + 5ms);
    });
    CHECK(count == 100);
}

TEST_CASE("schedule: writes go before polls, but leave every other turn to the polls")
{
    schedule s(1);
    for (int i = 0; i < 3; ++i)
        s.add_poll(0, 100ms);
    const std::size_t write = s.add_write(0);
    s.start(t0);
    time_point now = t0 + 200ms;  // all polls are due
    turns items;
    for (int i = 0; i < 6; ++i) {
        s.ask(write);
        const turns one = next_turns(s, now, 1, 1ms);
        items.insert(items.end(), one.begin(), one.end());
    }
    CHECK(items == turns{write, 0, write, 1, write, 2});
}

TEST_CASE("schedule: without a poll that is due, writes follow each other, and take turns")
{
    schedule s(1);
    s.add_poll(0, 1h);
    const std::size_t first = s.add_write(0);
    const std::size_t second = s.add_write(0);
    s.start(t0);
    time_point now = t0;
    CHECK(next_turns(s, now, 1) == turns{0});
    turns items;
    for (int i = 0; i < 4; ++i) {
        s.ask(first);
        s.ask(second);
        const turns one = next_turns(s, now, 1);
        items.insert(items.end(), one.begin(), one.end());
    }
    CHECK(items == turns{first, second, first, second});
}

TEST_CASE("schedule: a write goes out once, however often it was asked for, and again when asked while it is out")
{
    schedule s(1);
    const std::size_t write = s.add_write(0);
    s.start(t0);
    s.ask(write);
    s.ask(write);
    time_point now = t0;
    CHECK(next_turns(s, now, 5) == turns{write});

    s.ask(write);
    const auto turn = s.next(now);
    REQUIRE(turn.has_value());
    s.ask(write);
    s.finished(*turn, schedule::outcome::answered, 10ms, now);
    CHECK(next_turns(s, now, 5) == turns{write});
}

TEST_CASE("schedule: what was missed is skipped, not caught up")
{
    schedule s(1);
    s.add_poll(0, 1s);
    s.start(t0);
    time_point now = t0;
    CHECK(next_turns(s, now, 5) == turns{0});

    now = t0 + 1h;  // the port was away
    CHECK(next_turns(s, now, 5) == turns{0});
    CHECK(s.wake_at(now) >= t0 + 1h + 900ms);
}

TEST_CASE("schedule: a line that is slightly late does not lose a turn")
{
    schedule s(1);
    s.add_poll(0, 100ms);
    s.start(t0);
    time_point now = t0 + 60ms;  // held up by somebody else
    CHECK(next_turns(s, now, 5) == turns{0});
    CHECK(s.wake_at(now) == t0 + 100ms);
}

TEST_SUITE_END();
