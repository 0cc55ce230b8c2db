// What a line does about stations that do not answer, turn by turn.
#include "tests/support/play.hpp"
#include "tests/support/virtual_time.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

TEST_CASE("schedule: a suspect station is asked the same question again, once and without retries, before any other")
{
    schedule s(2);
    for (int i = 0; i < 4; ++i)
        s.add_poll(i == 3 ? 1 : 0, 400ms);  // due 80 ms apart
    const std::size_t write = s.add_write(0);
    s.start(t0);
    time_point now = t0;
    CHECK(schedule(s).next(now)->with_retries);
    CHECK(next_turns(s, now, 1) == turns{0});
    now = t0 + 80ms;
    fail(s, now, 1, 5ms);
    CHECK(s.state_of(0) == health::suspect);
    CHECK(s.state_of(1) == health::healthy);

    s.ask(write);
    now = t0 + 2s;  // everything is due
    turns items;
    while (s.state_of(0) == health::suspect) {
        const auto turn = s.next(now);
        REQUIRE(turn.has_value());
        items.push_back(turn->item);
        CHECK(turn->with_retries == (turn->item == 3));
        now += 10ms;
        s.finished(*turn, schedule::outcome::answered, 10ms, now);
    }
    CHECK(items.back() == 1);
    for (std::size_t i = 0; i + 1 < items.size(); ++i)
        CHECK(items[i] == 3);  // the other station goes on
    now += 10s;
    const auto wanted = s.next(now);
    CHECK(wanted->item == write);
    CHECK(wanted->with_retries);
}

TEST_CASE(
    "schedule: after an answer that may belong to another question the station rests, unless answers are numbered")
{
    for (const bool numbered : {false, true}) {
        CAPTURE(numbered);
        schedule s(1);
        s.add_poll(0, 100ms);
        if (numbered)
            s.set_numbered_answers();
        s.start(t0);
        time_point now = t0;
        fail(s, now, 0, 500ms);
        const auto again = s.next(now);
        REQUIRE(again.has_value());
        now += 10ms;
        s.finished(*again, schedule::outcome::answered, 10ms, now);
        CHECK((s.quiet_until(0) > now) == !numbered);
    }
}

TEST_CASE("schedule: questions that were under way together and are lost together are one failure")
{
    schedule s(1);
    s.set_parallel(4);
    for (int i = 0; i < 4; ++i)
        s.add_poll(0, 100ms);
    s.start(t0);
    const time_point asked = t0 + 1s;
    std::vector<schedule::turn> out;
    while (const auto turn = s.next(asked))
        out.push_back(*turn);
    REQUIRE(out.size() == 4);
    for (const schedule::turn& each : out)
        s.finished(each, schedule::outcome::silent, 500ms, asked + 500ms);
    CHECK(s.state_of(0) == health::suspect);
    time_point now = asked + 510ms;
    fail(s, now, out.front().item);  // the same question again
    CHECK(s.state_of(0) == health::down);
}

TEST_CASE("schedule: one lost answer of a slow poll does not stop the station's fast polls")
{
    schedule s(1);
    const std::size_t fast = s.add_poll(0, 100ms);
    const std::size_t slow = s.add_poll(0, 60s);
    s.start(t0);
    bool lost = false;
    time_point lost_at{};
    std::optional<time_point> fast_again;
    play(s, t0, t0 + 100s, [&](const schedule::turn& turn, time_point now) {
        if (turn.item == slow && !lost) {
            lost = true;
            lost_at = now;
            return silent(1s);
        }
        if (turn.item == fast && lost && !fast_again)
            fast_again = now;
        return answers(20ms);
    });
    REQUIRE(lost);
    REQUIRE(fast_again.has_value());
    CHECK(*fast_again - lost_at <= 3s);
}

TEST_CASE("schedule: two failures take a station down; a failed write stays wanted and goes out after recovery")
{
    schedule s(1);
    const std::size_t poll = s.add_poll(0, 1h);
    const std::size_t write = s.add_write(0);
    const std::size_t other_write = s.add_write(0);
    s.start(t0);
    time_point now = t0;
    CHECK(next_turns(s, now, 1) == turns{poll});
    s.ask(write);
    fail(s, now, write, 1s);
    CHECK(s.state_of(0) == health::suspect);
    fail(s, now, write);
    CHECK(s.state_of(0) == health::down);
    s.ask(other_write);
    CHECK_FALSE(s.next(now).has_value());
    CHECK(s.wake_at(now) <= now + 1s);

    now = s.wake_at(now);
    CHECK_FALSE(schedule(s).next(now)->with_retries);
    CHECK(next_turns(s, now, 1) == turns{write});  // the probe asks the same question
    CHECK(s.state_of(0) == health::healthy);
    now += 10s;
    CHECK(next_turns(s, now, 5) == turns{other_write});  // and that was that write
}

TEST_CASE("schedule: a question that never went out is nobody's fault; a write of that kind stays wanted")
{
    schedule s(1);
    const std::size_t poll = s.add_poll(0, 100ms);
    const std::size_t write = s.add_write(0);
    s.start(t0);
    time_point now = t0;
    for (int i = 0; i < 5; ++i) {
        now = std::max(now, s.wake_at(now));
        const auto turn = s.next(now);
        REQUIRE(turn.has_value());
        CHECK(turn->with_retries);
        now += 500ms;
        s.finished(*turn, schedule::outcome::not_asked, 500ms, now);
        CHECK(s.state_of(0) == health::healthy);
    }
    now = std::max(now, s.wake_at(now));
    CHECK(next_turns(s, now, 1) == turns{poll});

    s.ask(write);
    const auto turn = s.next(now);
    REQUIRE(turn.has_value());
    CHECK(turn->item == write);
    s.finished(*turn, schedule::outcome::not_asked, 1ms, now);
    now += 100ms;
    const turns after = next_turns(s, now, 2, 1ms);
    CHECK(std::find(after.begin(), after.end(), write) != after.end());
}

TEST_CASE("schedule: writes to a station that a poll took down go out after recovery")
{
    schedule s(1);
    const std::size_t poll = s.add_poll(0, 100ms);
    const std::size_t write = s.add_write(0);
    s.start(t0);
    time_point now = t0;
    fail(s, now, poll);
    fail(s, now, poll);
    s.ask(write);
    CHECK_FALSE(s.next(now).has_value());
    now = s.wake_at(now);
    CHECK(next_turns(s, now, 1) == turns{poll});
    now += 10s;
    CHECK(next_turns(s, now, 1) == turns{write});
}

TEST_SUITE_END();
