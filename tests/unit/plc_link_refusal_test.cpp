// Stations that a PLC link does not take in: wrong numbers, send areas that belong to others. FP7 manual 6.3.1, 6.3.6.
#include "tests/support/print.hpp"
#include "tests/unit/plc_link_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::test;

namespace {

// Station 1 sends the words 0 to 9 of WL and LD, station 2 of gateway "two" the words 10 to 19.
struct cell : linked_plc {
    cell() : linked_plc("one", sends(1, 0, 10))
    {
        set("WL9", 3);
        link.received(t0, area(process("two", 5), sends(2, 10, 10), 2));
        said();
    }
};

plc_link_station only_relays(unsigned station, unsigned first, unsigned count)
{
    return {station, {.relay_first = first, .relay_count = count}};
}

plc_link_station only_registers(unsigned station, unsigned first, unsigned count)
{
    return {station, {.register_first = first, .register_count = count}};
}

plc_link_station of_17() { return {17, {}}; }

}  // namespace

TEST_CASE("plc link: a station that overlaps, or has a number of another, is refused and said once")
{
    const struct {
        plc_link_sender from;
        plc_link_station station;
        const char* why;
    } rows[] = {
        {process("three"), only_relays(3, 9, 2),
         "relay_first sends WL9-WL10, which overlaps with WL0-WL9 of station 1"},
        {process("three"), only_relays(3, 19, 2),
         "relay_first sends WL19-WL20, which overlaps with WL10-WL19 of station 2"},
        {process("three"), only_registers(3, 0, 1),
         "register_first sends LD0-LD0, which overlaps with LD0-LD9 of station 1"},
        {process("three"), only_registers(3, 15, 1),
         "register_first sends LD15-LD15, which overlaps with LD10-LD19 of station 2"},
        {process("three"), only_relays(1, 30, 1), "it is the number of this PLC, one"},
        {process("one", 2), only_relays(1, 30, 1), "it is the number of this PLC, one"},
        {process("three"), only_relays(2, 30, 1), "gateway two (host) has this number"},
        {process("two", 4), only_relays(2, 30, 1), "a gateway of the same name, started later, has this number"},
        {process("three"), only_relays(0, 30, 1), "station is 0, but a PLC link has the stations 1 to 16"},
        {process("three"), of_17(), "station is 17, but a PLC link has the stations 1 to 16"},
        {process("three"), only_relays(3, 63, 2),
         "relay_count sends WL63-WL64, but this PLC uses only 64 words for the link: raise relay_words"},
        {process("three"), only_relays(3, 200, 1), "relay_first is 200, expected 0 to 63"},
        {process("three"), only_registers(3, 0, 128), "register_count is 128, expected 0 to 127"},
    };
    for (const auto& row : rows) {
        cell c;
        const plc_link_area heard = area(row.from, row.station, 9);
        INFO(std::string(row.why));
        c.link.received(t0, heard);
        CHECK(c.said() == "warning: PLC link cell: station " + std::to_string(row.station.station) + " of gateway " +
                              row.from.gateway + " (host) is refused: " + row.why);
        c.link.received(t0 + 200ms, heard);
        CHECK(c.said() == "");
        CHECK(c.link.others() == std::vector<unsigned>{2});
        for (const char* device : {"WL0", "WL20", "WL30", "WL63", "LD0", "LD30"})
            CHECK(c.word(device) == 0);
        CHECK(c.word("WL9") == 3);
        CHECK(c.word("WL10") == 2);
        CHECK(c.word("LD15") == 2);
    }
}

TEST_CASE("plc link: neighbours do not overlap")
{
    cell c;
    c.link.received(t0, area(process("three"), sends(3, 20, 44), 4));
    CHECK(c.said() == "PLC link cell: station 3 of gateway three (host) takes part");
    CHECK(c.word("WL19") == 2);
    CHECK(c.word("WL20") == 4);
}

TEST_CASE("plc link: the refused one is taken in when the other has gone, and said again if it is refused again")
{
    cell c;
    const plc_link_area late = area(process("three"), sends(3, 15, 5), 9);
    c.link.received(t0, late);
    c.said();
    c.link.gone(t0, {"cell", "two", "host", 2});
    CHECK(c.word("WL15") == 2);  // not before it sends
    c.link.received(t0 + 1s, late);
    CHECK(c.word("WL15") == 9);
    CHECK(c.link.others() == std::vector<unsigned>{3});
    c.said();
    c.link.received(t0 + 1s, area(process("two", 6), sends(2, 10, 10), 2));
    CHECK(c.said() == "warning: PLC link cell: station 2 of gateway two (host) is refused: relay_first sends "
                      "WL10-WL19, which overlaps with WL15-WL19 of station 3");
    c.link.gone(t0, {"cell", "two", "host", 2});
    CHECK(c.said() == "");
    c.link.received(t0 + 2s, area(process("two", 7), sends(2, 10, 10), 2));
    CHECK(c.said() != "");
}

TEST_CASE("plc link: a gateway that was started again takes its station over at once, with another area too")
{
    cell c;
    c.link.received(t0, area(process("two", 6), sends(2, 30, 5), 9));
    CHECK(c.word("WL30") == 9);
    c.said();
    c.link.received(t0, area(process("three"), sends(3, 10, 10), 4));  // free now
    CHECK(c.word("WL10") == 4);
    c.said();
    c.link.received(t0, area(process("two", 5), sends(2, 30, 5), 1));  // what was under way of the old process
    CHECK(c.word("WL30") == 9);
}

TEST_CASE("plc link: another highest station is said, but the words come")
{
    plc_link_station other = sends(3, 20, 1);
    other.settings.max_station = 4;
    cell c;
    c.link.received(t0, area(process("three"), other, 9));
    CHECK(c.word("WL20") == 9);
    CHECK(c.said() == "warning: PLC link cell: station 3 of gateway three (host) takes part, but its max_station is 4, "
                      "but 16 in station 1: it must be the same in all of them");
}

TEST_CASE("plc link: our own words and other links do not come in")
{
    cell c;
    c.link.received(t0, area(process("one"), sends(1, 0, 10), 9));
    plc_link_area other = area(process("three"), sends(3, 20, 1), 9);
    other.link = "line";
    c.link.received(t0, other);
    CHECK(c.word("WL9") == 3);
    CHECK(c.word("WL20") == 0);
    CHECK(c.said() == "");
}

TEST_CASE("plc link: made-up names do not fill the memory of what was said")
{
    cell c;
    for (int i = 0; i < 1000; ++i)
        c.link.received(t0, area(process("gateway" + std::to_string(i)), sends(1, 30, 1)));
    CHECK(c.link.take_events().size() <= 64);
}

TEST_SUITE_END();
