// A PLC link at work: what goes out when, and what comes in where. FP7 manual 6.1 and 6.3.
#include "tests/support/print.hpp"
#include "tests/unit/plc_link_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::test;

TEST_CASE("plc link: what one station sets, all others have under the same number")
{
    linked_plc one("one", sends(1, 0, 20));
    linked_plc two("two", sends(2, 20, 20));
    linked_plc three("three", sends(3, 0, 0));  // only listens
    one.set_bit("L0", true);
    one.set_bit("L19F", true);
    one.set("LD0", 100);
    two.set("LD39", 200);
    two.set("WL20", 0x8001);
    linked_plc* const all[] = {&one, &two, &three};
    for (linked_plc* const from : all) {
        const auto sent = from->next(t0);
        REQUIRE(sent);
        for (linked_plc* const to : all)
            to->link.received(t0, *sent);
    }
    for (const linked_plc* const each : all) {
        INFO(each->plc.name());
        CHECK(each->bit("L0"));
        CHECK_FALSE(each->bit("L1"));
        CHECK(each->bit("L19F"));
        CHECK(each->word("LD0") == 100);
        CHECK(each->word("LD39") == 200);
        CHECK(each->word("WL20") == 0x8001);
    }
    CHECK(one.link.others() == std::vector<unsigned>{2, 3});
    CHECK(two.said() == "PLC link cell: station 1 of gateway one (host) takes part\n"
                        "PLC link cell: station 3 of gateway three (host) takes part");
    two.link.received(t0, *one.next(t0 + 1s));
    CHECK(two.said() == "");
}

TEST_CASE("plc link: words are sent at once, then not more often than each 10 ms, and every 200 ms unchanged")
{
    linked_plc one("one", sends(1, 4, 2));
    CHECK(one.link.wake_at() == time_point::min());
    const auto first = one.next(t0);
    REQUIRE(first);
    CHECK(first->sequence == 1);
    CHECK(first->source == wall_time{7});
    CHECK(first->relays == std::vector<std::uint16_t>{0, 0});
    CHECK_FALSE(one.next(t0));
    CHECK(one.link.wake_at() == t0 + 200ms);
    CHECK_FALSE(one.next(t0 + 199ms));

    const auto unchanged = one.next(t0 + 200ms);
    REQUIRE(unchanged);
    CHECK(unchanged->sequence == 2);

    one.set("WL5", 9);
    CHECK(one.settle());
    CHECK(one.link.wake_at() == t0 + 210ms);
    CHECK_FALSE(one.next(t0 + 209ms));
    one.set("WL5", 10);  // the latest words go out
    CHECK(one.settle());
    CHECK(one.next(t0 + 210ms)->relays == std::vector<std::uint16_t>{0, 10});

    one.set("LD4", 11);
    CHECK(one.settle());
    CHECK(one.next(t0 + 300ms)->registers == std::vector<std::uint16_t>{11, 0});  // at once: it was silent for long
    CHECK(one.link.wake_at() == t0 + 500ms);
}

TEST_CASE("plc link: only words of the own send area are a reason to send")
{
    linked_plc one("one", sends(1, 4, 2));
    one.next(t0);
    for (const char* device : {"WL3", "WL6", "LD3", "LD6", "DT4", "WR4", "WL68"}) {
        INFO(std::string(device));
        one.set(device, 1);
        CHECK_FALSE(one.settle());
    }
    one.set_bit("L5F", true);
    CHECK(one.settle());
    linked_plc two("two", sends(2, 4, 2));
    two.set("WL4", 1);
    for (const plc::change& each : two.plc.memory().take_changes())
        CHECK_FALSE(one.link.memory_changed(two.plc, each));
}

TEST_CASE("plc link: block 1 is WL64 and LD128 onwards, also for what a station with block 0 sends")
{
    plc_link_station upper = sends(2, 20, 1);
    upper.settings.block = 1;
    linked_plc one("one", sends(1, 0, 1));
    linked_plc two("two", upper);
    one.set("WL0", 5);
    one.set("LD0", 6);
    two.set("WL84", 7);
    two.set("LD148", 8);
    const auto from_one = one.next(t0);
    const auto from_two = two.next(t0);
    two.link.received(t0, *from_one);
    one.link.received(t0, *from_two);
    CHECK(two.word("WL64") == 5);
    CHECK(two.word("LD128") == 6);
    CHECK(two.word("WL0") == 0);
    CHECK(one.word("WL20") == 7);
    CHECK(one.word("LD20") == 8);
}

TEST_CASE("plc link: words beyond those that this PLC uses for the link do not come in")
{
    plc_link_station own = sends(1, 0, 2);
    own.settings.relay_words = 21;
    own.settings.register_words = 22;
    linked_plc one("one", own);
    one.link.received(t0, area(process("two"), sends(2, 20, 4), 9));
    CHECK(one.word("WL20") == 9);
    CHECK(one.word("WL21") == 0);
    CHECK(one.word("LD21") == 9);
    CHECK(one.word("LD22") == 0);
    CHECK(
        one.said() ==
        "warning: PLC link cell: station 2 of gateway two (host) takes part, but in this PLC, one, relay_words is 21, "
        "but station 2 sends WL20-WL23: raise it, it would not be seen here; in this PLC, one, register_words is 22, "
        "but station 2 sends LD20-LD23: raise it, it would not be seen here");
}

TEST_CASE("plc link: a PLC that was switched off has the words of the others again with their next sending")
{
    linked_plc one("one", sends(1, 0, 2));
    const plc_link_area heard = area(process("two"), sends(2, 2, 2), 9);
    one.link.received(t0, heard);
    one.plc.power_cycle();
    CHECK(one.word("WL2") == 0);
    one.link.received(t0 + 200ms, heard);
    CHECK(one.word("WL2") == 9);
}

TEST_CASE("plc link: what comes in from others is no reason to send")
{
    linked_plc one("one", sends(1, 0, 2));
    one.next(t0);
    one.link.received(t0, area(process("two"), sends(2, 2, 62), 9));
    CHECK_FALSE(one.settle());
    CHECK(one.word("WL1") == 0);
    CHECK(one.word("WL63") == 9);
}

TEST_CASE("plc link: a station that is silent for a second is gone, and its words stay")
{
    linked_plc one("one", sends(1, 0, 2));
    const plc_link_area heard = area(process("two"), sends(2, 2, 2), 9);
    one.link.received(t0, heard);
    one.link.received(t0 + 200ms, heard);
    one.said();
    one.next(t0 + 1150ms);
    CHECK(one.link.wake_at() == t0 + 1200ms);  // before its own next sending
    one.link.look(t0 + 1199ms);
    CHECK(one.link.others() == std::vector<unsigned>{2});
    one.link.look(t0 + 1200ms);
    CHECK(one.link.others().empty());
    CHECK(one.said() == "warning: PLC link cell: station 2 of gateway two (host) is gone: its words stay as they were");
    CHECK(one.word("WL2") == 9);
    one.link.received(t0 + 5s, heard);
    CHECK(one.said() == "PLC link cell: station 2 of gateway two (host) takes part");
}

TEST_CASE("plc link: a station whose writer ended is gone at once")
{
    linked_plc one("one", sends(1, 0, 2));
    one.link.received(t0, area(process("two"), sends(2, 2, 2), 9));
    one.said();
    one.link.gone(t0, {"other", "two", "host", 2});
    one.link.gone(t0, {"cell", "three", "host", 2});
    one.link.gone(t0, {"cell", "two", "elsewhere", 2});
    one.link.gone(t0, {"cell", "two", "host", 3});
    CHECK(one.link.others() == std::vector<unsigned>{2});
    one.link.gone(t0, {"cell", "two", "host", 2});
    CHECK(one.link.others().empty());
    CHECK(one.said() == "warning: PLC link cell: station 2 of gateway two (host) is gone: its words stay as they were");
}

TEST_SUITE_END();
