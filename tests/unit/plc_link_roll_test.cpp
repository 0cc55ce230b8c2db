// What a PLC link knows of the other stations: who takes part, who is refused and why, who is gone and since when.
#include "tests/unit/plc_link_bench.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::test;

namespace {

std::string seen(const plc_link_exchange& link, time_point now)
{
    constexpr const char* states[] = {"active", "refused", "gone"};
    std::string text;
    for (const plc_link_seen& each : link.seen(now))
        text.append(text.empty() ? "" : "\n")
            .append(std::to_string(each.station.station) + " " + each.gateway + " " +
                    states[static_cast<std::size_t>(each.state)] + " " + std::to_string((now - each.since) / 1ms) +
                    " heard " + std::to_string((now - each.heard) / 1ms) + (each.reason.empty() ? "" : ": ") +
                    each.reason);
    return text;
}

}  // namespace

TEST_CASE("plc link: who takes part, is refused and is gone can be seen, with the time")
{
    linked_plc one("one", sends(1, 0, 10));
    CHECK(seen(one.link, t0) == "");
    one.link.received(t0, area(process("two"), sends(2, 10, 10)));
    one.link.received(t0 + 100ms, area(process("three"), sends(3, 15, 10)));
    one.link.received(t0 + 400ms, area(process("two"), sends(2, 10, 10)));
    const std::string now_seen = seen(one.link, t0 + 500ms);
    CHECK(
        now_seen.starts_with("2 two active 500 heard 100\n3 three refused 400 heard 400: relay_first sends WL15-WL24"));

    // Nobody says good-bye: one is given up by its silence, and so is who was refused.
    one.link.look(t0 + 1400ms);
    CHECK(seen(one.link, t0 + 2s) == "2 two gone 600 heard 1600\n3 three gone 900 heard 1900");

    // The way is free now; who was there first comes too late.
    one.link.received(t0 + 3s, area(process("three"), sends(3, 15, 10)));
    one.link.received(t0 + 3s, area(process("two"), sends(2, 10, 10)));
    CHECK(seen(one.link, t0 + 3s).starts_with("2 two refused 0 heard 0: relay_first sends WL10-WL19"));
    CHECK(seen(one.link, t0 + 3s).ends_with("3 three active 0 heard 0"));

    one.link.gone(t0 + 4s, {"cell", "three", "host", 3});
    CHECK(seen(one.link, t0 + 5s).ends_with("3 three gone 1000 heard 2000"));
    CHECK(one.link.others().empty());
}

TEST_CASE("plc link: a station that takes part with a reservation says which")
{
    linked_plc one("one", sends(1, 0, 10));
    plc_link_station other = sends(2, 10, 10);
    other.settings.max_station = 5;
    one.link.received(t0, area(process("two"), other));
    CHECK(seen(one.link, t0).starts_with("2 two active 0 heard 0: "));
    CHECK(seen(one.link, t0).find("max_station is 5") != std::string::npos);
}

TEST_CASE("plc link: names that somebody makes up do not fill the memory, nor push out who takes part")
{
    linked_plc one("one", sends(1, 0, 10));
    one.link.received(t0, area(process("two"), sends(2, 10, 10)));
    for (unsigned i = 0; i < 200; ++i)
        one.link.received(t0 + i * 1ms, area(process("x" + std::to_string(i)), sends(2, 10, 10)));
    const std::vector<plc_link_seen> all = one.link.seen(t0 + 200ms);
    CHECK(all.size() == plc_link_roll::most);
    CHECK(all.front().gateway == "two");
    CHECK(all.front().state == plc_link_state::active);
}

TEST_CASE("plc link: a channel reset takes the stations in anew and sends at once")
{
    linked_plc one("one", sends(1, 0, 10));
    CHECK(one.next(t0).has_value());
    one.link.received(t0, area(process("two"), sends(2, 10, 10), 2));
    one.said();
    CHECK_FALSE(one.next(t0 + 5ms).has_value());
    one.link.reset();
    CHECK(one.link.others().empty());
    CHECK(seen(one.link, t0 + 5ms) == "");
    CHECK(one.word("WL10") == 2);
    CHECK(one.next(t0 + 5ms).has_value());
    one.link.received(t0 + 6ms, area(process("two"), sends(2, 10, 10), 3));
    CHECK(one.said() == "PLC link cell: station 2 of gateway two (host) takes part");
    CHECK(one.word("WL10") == 3);
}

TEST_SUITE_END();
