// Hours of faults: whatever happens, two members do not speak on one wire, and somebody speaks within a bound.
#include "tests/unit/pair_world.hpp"

#include <doctest/doctest.h>

#include <random>

TEST_SUITE_BEGIN("standby");

using namespace plcgw;
using namespace plcgw::test;

namespace {

// What a fault and the recovery from it may take, all steps of it: lease, listening, the line's limit and slots.
constexpr duration bound = 12s;

struct faults {
    pair_world& w;
    std::mt19937 dice;
    bool network_fails = false;
    bool cables_fail = true;

    int any() { return static_cast<int>(dice() % 2); }

    void one()
    {
        const int who = any();
        pair_world::process& p = w.members[static_cast<std::size_t>(who)];
        switch (dice() % 9) {
        case 0: w.kill(who); break;
        case 1: w.stop(who); break;
        case 2:
            if (w.works(who))
                w.end(who);
            break;
        case 3: w.plug(who, dice() % 2, !cables_fail); break;
        case 4: w.network = !network_fails; break;
        case 5: w.wires[dice() % 2].has_device = false; break;
        case 6:
            if (w.works(who))
                p.pair->switch_over(w.now);
            break;
        default:
            w.stop(who);
            w.run(std::chrono::milliseconds(dice() % 900));
            w.go_on(who);
        }
    }

    void restore(int who, std::size_t line)
    {
        w.plug(who, line, true);
        if (!w.members[static_cast<std::size_t>(who)].present[line])
            w.attach(who, line, true);
    }

    void heal()
    {
        for (const int who : {0, 1}) {
            w.go_on(who);
            if (!w.members[static_cast<std::size_t>(who)].pair)
                w.start(who);
            for (std::size_t line = 0; line < pair_world::lines; ++line)
                restore(who, line);
        }
        for (pair_world::wire& each : w.wires)
            each.has_device = true;
        w.network = true;
    }
};

void an_hour(pair_world& w, faults& f)
{
    w.run(5s);
    for (const time_point end = w.now + 1h; w.now < end;) {
        for (auto left = 1 + f.dice() % 3; left > 0; --left) {
            f.one();
            w.run(std::chrono::milliseconds(f.dice() % 4000));
        }
        f.heal();
        w.run(bound);
        CAPTURE(w.now.time_since_epoch() / 1ms);
        REQUIRE(w.is_active(0) != w.is_active(1));
        for (std::size_t line = 0; line < pair_world::lines; ++line)
            REQUIRE(w.now - w.last_question[line] <= 200ms);
    }
}

}  // namespace

TEST_CASE("pair: an hour of faults with a network: never two on a wire, always one soon")
{
    for (unsigned seed = 1; seed <= 2; ++seed) {
        CAPTURE(seed);
        pair_world w(seed % 2 == 0);
        faults f{w, std::mt19937(seed)};
        an_hour(w, f);
        CHECK_MESSAGE(w.collisions.empty(), w.collisions.front());
        CHECK(w.both_active == 0);
    }
}

TEST_CASE("pair: an hour of faults, of the network too: never two on a wire")
{
    for (unsigned seed = 11; seed <= 12; ++seed) {
        CAPTURE(seed);
        pair_world w(seed % 2 == 0);
        faults f{w, std::mt19937(seed), true, false};
        an_hour(w, f);
        CHECK_MESSAGE(w.collisions.empty(), w.collisions.front());
    }
}

// A cable that is plugged in again, between two members that hear of each other by the wire alone: one question may
// meet another before somebody gives way.
TEST_CASE("pair: an hour of faults, of network and cables at the same time: hardly ever, and never for long")
{
    for (unsigned seed = 21; seed <= 22; ++seed) {
        CAPTURE(seed);
        pair_world w(seed % 2 == 0);
        faults f{w, std::mt19937(seed), true, true};
        an_hour(w, f);
        CAPTURE(w.collisions.size());
        CHECK(w.collisions.size() <= 3);
    }
}

TEST_SUITE_END();
