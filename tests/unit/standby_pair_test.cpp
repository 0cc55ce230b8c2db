// Who of two members is active, and who may ask on a line: each fault by itself, in virtual time.
#include "tests/unit/pair_world.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("standby");

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr int a = 0;  // the preferred one
constexpr int b = 1;

bool only(const pair_world& w, int who) { return w.is_active(who) && !w.is_active(1 - who); }

}  // namespace

TEST_CASE("pair: both start, listen, and the preferred one begins")
{
    pair_world w;
    w.run(1900ms);
    CHECK_FALSE(w.is_active(a));
    CHECK_FALSE(w.is_active(b));
    w.run(1s);
    CHECK(only(w, a));
    CHECK(w.questions[a][0] > 0);
    CHECK(w.questions[b][0] == 0);
    CHECK(w.members[b].pair->term() == w.members[a].pair->term());
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: one alone begins after it has listened")
{
    pair_world w;
    w.kill(a);
    w.run(6s);
    CHECK(only(w, b));
    CHECK(w.members[b].pair->why().find("is not heard") != std::string::npos);
}

TEST_CASE("pair: a killed member is replaced when its lease has run out and its lines are silent")
{
    pair_world w;
    w.run(4s);
    w.kill(a);
    const duration took = w.until_spoken(b, 0, 10s);
    CHECK(took >= pair_world::lease - 100ms);
    CHECK(took <= pair_world::quiet + 200ms);
    CHECK(only(w, b));
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: one that ends says so, and is replaced at once")
{
    pair_world w;
    w.run(4s);
    w.end(a);
    CHECK(w.until_spoken(b, 0, 10s) <= 150ms);
}

TEST_CASE("pair: a member that stood still asks nothing before it has listened")
{
    pair_world w;
    w.run(4s);
    w.stop(a);
    w.run(3s);
    CHECK(only(w, b));
    const unsigned asked = w.questions[a][0];
    w.go_on(a);
    w.run(pair_world::step);
    CHECK(w.questions[a][0] == asked);
    CHECK_FALSE(w.is_active(a));
    CHECK(w.members[a].pair->speaks_until(0) <= w.now);
    w.run(2s);
    CHECK(only(w, b));
    CHECK(w.questions[a][0] == asked);
    w.run(6s);
    CHECK(only(w, a));  // by agreement
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: a stop shorter than the lease changes nothing")
{
    pair_world w;
    w.run(4s);
    w.stop(a);
    w.run(300ms);
    w.go_on(a);
    w.run(2s);
    CHECK(only(w, a));
    CHECK(w.members[a].pair->term() == 1);
}

TEST_CASE("pair: handed back only where that is wanted")
{
    for (const bool hand_back : {true, false}) {
        pair_world w(hand_back);
        w.run(4s);
        w.kill(a);
        w.run(3s);
        w.start(a);
        w.run(1s);
        CHECK(only(w, b));
        w.run(10s);
        CHECK(only(w, hand_back ? a : b));
        CHECK(w.collisions.empty());
        CHECK(w.both_active == 0);
    }
}

TEST_CASE("pair: a pulled cable moves the role, and it stays there until the cable is back")
{
    pair_world w;
    w.run(4s);
    w.plug(a, 0, false);
    CHECK(w.until_spoken(b, 0, 10s) <= pair_world::limit + 600ms);
    CHECK(only(w, b));
    w.run(30s);
    CHECK(only(w, b));
    w.plug(a, 0, true);
    w.run(10s);
    CHECK(only(w, a));
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: an adapter that is gone moves the role, and hands it back")
{
    pair_world w;
    w.run(4s);
    w.attach(a, 1, false);
    CHECK(w.until_spoken(b, 1, 10s) <= pair_world::limit + 600ms);
    w.run(30s);
    CHECK(only(w, b));
    w.attach(a, 1, true);
    w.run(10s);
    CHECK(only(w, a));
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: a standby without its own cable does not take what it cannot use")
{
    pair_world w;
    w.run(4s);
    w.plug(b, 0, false);
    w.run(30s);
    CHECK(only(w, a));
    CHECK(w.members[a].pair->term() == 1);
}

TEST_CASE("pair: both cables pulled is tried once, and not for ever")
{
    pair_world w;
    w.run(4s);
    w.plug(a, 0, false);
    w.plug(b, 0, false);
    w.run(60s);
    CHECK(w.members[a].pair->term() <= 5);
    CHECK(w.is_active(a) != w.is_active(b));
}

TEST_CASE("pair: devices that are silent are no reason")
{
    pair_world w;
    w.run(4s);
    w.wires[0].has_device = w.wires[1].has_device = false;
    w.run(60s);
    CHECK(only(w, a));
    CHECK(w.members[a].pair->term() == 1);
    w.network = false;  // nor without the network
    w.run(60s);
    CHECK(only(w, a));
    CHECK(w.questions[b][0] == 0);
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: a member that may be alone listens to a dead line between its questions")
{
    pair_line line({"one", 800ms, 2s, true});
    time_point now{1h};
    line_heard heard;
    heard.listens = heard.port_open = true;
    heard.open_since = now;
    line.heard(heard);
    line.look(now += 1s, certainty::guessed, 100ms);
    line.begin(now);
    int speaks = 0;
    for (int i = 0; i < 1000; ++i) {
        line.heard(heard);
        line.look(now += 10ms, certainty::guessed, 100ms);
        speaks += now < line.speaks_until(time_point::max()) ? 1 : 0;
    }
    CHECK(speaks > 200);  // the first 800 ms, then 100 of each 500
    CHECK(speaks < 350);
    line.look(now, certainty::agreed, 100ms);
    CHECK(now < line.speaks_until(time_point::max()));
    heard.port_open = false;
    line.heard(heard);
    line.look(now, certainty::guessed, 100ms);
    CHECK(line.speaks());
    CHECK(now >= line.speaks_until(time_point::max()));
    heard.port_open = true;
    line.heard(heard);
    CHECK_FALSE(line.speaks());
}

TEST_CASE("pair: without the network the lines decide")
{
    pair_world w;
    w.run(4s);
    w.network = false;
    w.run(60s);
    CHECK(only(w, a));
    CHECK(w.questions[b][0] + w.questions[b][1] == 0);

    SUBCASE("one that is silent is taken, the others are not")
    {
        w.plug(a, 0, false);
        CHECK(w.until_spoken(b, 0, 10s) <= pair_world::limit + 300ms);
        w.run(10s);
        CHECK(w.questions[b][1] == 0);
        CHECK(only(w, a));
        CHECK(w.collisions.empty());
    }
    SUBCASE("a member that dies is replaced")
    {
        w.kill(a);
        CHECK(w.until_spoken(b, 0, 10s) <= pair_world::quiet + 300ms);
        CHECK(only(w, b));
        w.start(a);
        w.run(20s);
        CHECK(only(w, b));
        CHECK(w.questions[b][0] > 100);
        w.network = true;
        w.run(10s);
        CHECK(only(w, a));
        CHECK(w.collisions.empty());
    }
    SUBCASE("two that are active are one when it is back")
    {
        w.stop(a);
        w.run(3s);
        w.go_on(a);
        w.run(3s);
        CHECK(only(w, b));
        w.network = true;
        w.run(200ms);
        CHECK(only(w, b));
        CHECK(w.collisions.empty());
    }
}

TEST_CASE("pair: switched over by command, and not handed back")
{
    pair_world w;
    w.run(4s);
    for (const int asked : {a, b}) {  // the active one, then the standby
        CHECK_FALSE(w.members[static_cast<std::size_t>(asked)].pair->switch_over(w.now));
        CHECK(w.until_spoken(asked == a ? b : b, 0, 1s) <= 400ms);
        w.run(20s);
        CHECK(only(w, asked == a ? b : b));
        if (asked == a) {
            CHECK_FALSE(w.members[a].pair->switch_over(w.now));
            w.run(20s);
            CHECK(only(w, a));
        }
    }
    w.kill(b);
    w.run(2s);
    CHECK(w.members[a].pair->switch_over(w.now));
    CHECK(w.collisions.empty());
}

TEST_CASE("pair: of two active members the lower rank is silent, and says why")
{
    pair_settings s;
    s.member = "a";
    s.lease = 500ms;
    time_point now{1h};
    standby_pair p(s, now);
    for (int i = 0; i < 10; ++i)
        p.look(now += 100ms, {});
    REQUIRE(p.is_active(now));
    pair_beat other;
    other.member = "b";
    other.role = pair_role::active;
    other.term = p.term();
    other.priority = s.priority;
    SUBCASE("by term")
    {
        other.term += 1;
        other.priority = 0;
    }
    SUBCASE("by priority") { other.priority = s.priority + 1; }
    SUBCASE("by name") {}
    p.heard(now, other);
    CHECK_FALSE(p.is_active(now));
    CHECK(p.role() == pair_role::standby);
    CHECK(p.why().find("member b") != std::string::npos);
    CHECK(p.take_news());
}

TEST_CASE("pair: of two that claim at the same time the first one waits until the other has given up")
{
    pair_settings s;
    s.member = "b";
    s.lease = 500ms;
    time_point now{1h};
    standby_pair p(s, now);
    pair_beat other;
    other.member = "a";
    other.role = pair_role::standby;
    other.priority = s.priority;
    const auto look = [&] {
        p.heard(now, other);
        p.look(now += 100ms, {});
    };
    look();
    look();
    REQUIRE(p.beat().claims);
    other.claims = true;
    other.term = p.beat().term;
    for (int i = 0; i < 5; ++i) {
        look();
        CHECK_FALSE(p.is_active(now));
    }
    other.claims = false;
    look();
    CHECK(p.is_active(now));
    CHECK(p.term() == other.term);
}

TEST_SUITE_END();
