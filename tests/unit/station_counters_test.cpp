// The counters of FX3 manual 6.4: what each counts, who clears them, and where they are shown.
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using test::server_1;
using test::server_2;
using test::station_bench;
using words = std::vector<std::uint16_t>;

namespace {

// One of each: query, exception, neighbour, broadcast, refused broadcast, damage, overrun.
void play_everything(station_bench& b)
{
    b.ask(test::query);
    b.ask(test::bad_function);
    b.ask(modbus::unit_id{2}, test::query);
    b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01});
    b.tell_all({0x03, 0x00, 0x00, 0x00, 0x01});
    b.station.bus_error(errc::bad_checksum);
    b.station.bus_error(errc::overlong);
}

const words after_everything{5, 1, 2, 4, 2, 0, 0, 1, 2};

}  // namespace

TEST_CASE("station: what each counter counts")
{
    station_bench b;
    CHECK(b.counters() == words(9));
    //                                        bus err exc msg no  nak bsy ovr event
    b.ask(test::query);
    CHECK(b.counters() == words{1, 0, 0, 1, 0, 0, 0, 0, 1});
    b.ask({0x03, 0x00, 0x00, 0x00, 0x01});
    CHECK(b.counters() == words{2, 0, 0, 2, 0, 0, 0, 0, 2});
    b.ask(test::bad_function);
    CHECK(b.counters() == words{3, 0, 1, 3, 0, 0, 0, 0, 2});  // an exception is no event
    b.ask({0x03, 0xFF, 0xFF, 0x00, 0x01});
    CHECK(b.counters() == words{4, 0, 2, 4, 0, 0, 0, 0, 2});
    b.ask({0x0B});
    b.ask({0x0C});
    CHECK(b.counters() == words{6, 0, 2, 6, 0, 0, 0, 0, 2});  // and so are fetches of event counter and log
    b.ask({0x11});
    CHECK(b.counters() == words{7, 0, 2, 7, 0, 0, 0, 0, 3});
    b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01});
    CHECK(b.counters() == words{8, 0, 2, 8, 1, 0, 0, 0, 4});  // a broadcast has no response, but is carried out
    b.tell_all({0x06, 0xFF, 0xFF, 0x00, 0x01});
    CHECK(b.counters() == words{9, 0, 3, 9, 2, 0, 0, 0, 4});  // exceptions of broadcasts count
    b.tell_all({0x03, 0x00, 0x00, 0x00, 0x01});
    CHECK(b.counters() == words{10, 0, 4, 10, 3, 0, 0, 0, 4});
    b.ask(modbus::unit_id{2}, test::query);
    b.station.bus_message();  // the neighbour's response
    CHECK(b.counters() == words{12, 0, 4, 10, 3, 0, 0, 0, 4});
    b.station.bus_error(errc::bad_checksum);
    CHECK(b.counters() == words{12, 1, 4, 10, 3, 0, 0, 0, 4});
    b.station.bus_error(errc::overlong);
    CHECK(b.counters() == words{12, 1, 4, 10, 3, 0, 0, 1, 4});
}

TEST_CASE("station: sub-functions 0B to 12 and functions 0B and 0C read the counters")
{
    station_bench b;
    play_everything(b);
    CHECK(b.counters() == after_everything);
    //                                                              the question itself counts as a message
    CHECK(b.ask({0x08, 0x00, 0x0B, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0B, 0x00, 0x06});
    CHECK(b.ask({0x08, 0x00, 0x0C, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0C, 0x00, 0x01});
    CHECK(b.ask({0x08, 0x00, 0x0D, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0D, 0x00, 0x02});
    CHECK(b.ask({0x08, 0x00, 0x0E, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0E, 0x00, 0x08});
    CHECK(b.ask({0x08, 0x00, 0x0F, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0F, 0x00, 0x02});
    CHECK(b.ask({0x08, 0x00, 0x10, 0x00, 0x00}) == buffer{0x08, 0x00, 0x10, 0x00, 0x00});
    CHECK(b.ask({0x08, 0x00, 0x11, 0x00, 0x00}) == buffer{0x08, 0x00, 0x11, 0x00, 0x00});
    CHECK(b.ask({0x08, 0x00, 0x12, 0x00, 0x00}) == buffer{0x08, 0x00, 0x12, 0x00, 0x01});
    CHECK(b.ask({0x0B}) == buffer{0x0B, 0x00, 0x00, 0x00, 0x0A});
    const auto log = b.ask({0x0C});
    REQUIRE(log.has_value());
    CHECK(buffer(log->begin(), log->begin() + 8) == buffer{0x0C, 0x21, 0x00, 0x00, 0x00, 0x0A, 0x00, 0x0F});
}

TEST_CASE("station: who clears the counters")
{
    struct {
        const char* name;
        void (*act)(station_bench& b);
        words left;
    } const rows[] = {
        {"08 0A", [](station_bench& b) { b.ask(test::clear_counters); }, words(9)},
        {"08 0A by broadcast", [](station_bench& b) { b.tell_all(test::clear_counters); }, words(9)},
        {"08 01", [](station_bench& b) { b.ask(test::restart); }, words(9)},
        {"08 01, log too", [](station_bench& b) { b.ask(test::restart_and_clear_log); }, words(9)},
        {"08 01 by broadcast", [](station_bench& b) { b.tell_all(test::restart); }, words(9)},
        {"power", [](station_bench& b) { b.plc.power_cycle(); }, words(9)},
        {"STOP", [](station_bench& b) { b.plc.stop(); }, after_everything},
        {"STOP and RUN", [](station_bench& b) { b.plc.stop(), b.plc.run(); }, words(9)},
        {"RUN in RUN", [](station_bench& b) { b.plc.run(); }, after_everything},
        {"power in STOP", [](station_bench& b) { b.plc.stop(), b.plc.power_cycle(); }, words(9)},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b(std::string(server_1) + "H1 D8415, K100 D8416");
        play_everything(b);
        CHECK(b.word("D100") == 5);
        row.act(b);
        CHECK(b.counters() == row.left);
        for (std::size_t i = 0; i < 9; ++i)
            CHECK(b.word(("D" + std::to_string(100 + i)).c_str()) == row.left[i]);
    }
}

TEST_CASE("station: listen-only mode stops all counters (7.11.5)")
{
    station_bench b;
    play_everything(b);
    b.ask(test::listen_only);  // counted itself
    const words frozen{6, 1, 2, 5, 2, 0, 0, 1, 3};
    CHECK(b.counters() == frozen);
    play_everything(b);
    b.ask(test::clear_counters);
    CHECK(b.counters() == frozen);
    b.ask(test::restart);
    CHECK(b.counters() == words(9));
    play_everything(b);
    CHECK(b.counters() == after_everything);
}

TEST_CASE("station: the counters stop at FFFF")
{
    station_bench b(std::string(server_1) + "H1 D8415, K100 D8416");
    for (unsigned i = 0; i < 0xFFFE; ++i)
        b.station.bus_message();
    CHECK(b.count(counter::bus_message) == 0xFFFE);
    b.station.bus_message();
    CHECK(b.count(counter::bus_message) == 0xFFFF);
    b.station.bus_message();
    CHECK(b.count(counter::bus_message) == 0xFFFF);
    CHECK(b.word("D100") == 0xFFFF);
    CHECK(b.ask({0x08, 0x00, 0x0B, 0x00, 0x00}) == buffer{0x08, 0x00, 0x0B, 0xFF, 0xFF});

    comm_counters all;
    for (unsigned i = 0; i < 0x10001; ++i)
        for (std::uint8_t which = 0; which < 9; ++which)
            all.count(counter{which});
    for (std::uint8_t which = 0; which < 9; ++which)
        CHECK(all[counter{which}] == 0xFFFF);
    CHECK(all.registers()[9] == 0);
}

TEST_CASE("station: an event counter at FFFF is answered as such and starts again after a clear (7.12)")
{
    station_bench b;
    for (unsigned i = 0; i < 0x10000; ++i) {
        b.station.answer({modbus::unit_id{1}, {0x07}});
        b.station.sent();
    }
    CHECK(b.ask({0x0B}) == buffer{0x0B, 0x00, 0x00, 0xFF, 0xFF});
    b.ask(test::clear_counters);
    b.ask({0x07});
    CHECK(b.ask({0x0B}) == buffer{0x0B, 0x00, 0x00, 0x00, 0x01});
}

TEST_CASE("station: D100-D142 as in the table of 6.4, D8415 = 11H and D8416 = 100")
{
    station_bench b(std::string(server_1) + "H11 D8415, K100 D8416");
    for (unsigned i = 0; i < 43; ++i)
        CHECK(b.word(("D" + std::to_string(100 + i)).c_str()) == 0);
    play_everything(b);
    const words expected{5,      1,      2,      4,      2, 0, 0, 1, 2, 0,
                         8,  // events: newest first, two in a register
                         0x8290, 0xC0C0, 0x8041, 0x8040, 0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(b.word(("D" + std::to_string(100 + i)).c_str()) == expected[i]);
    }
    CHECK(b.word("D99") == 0);
    CHECK(b.word("D143") == 0);
    CHECK(b.log() == buffer{0x90, 0x82, 0xC0, 0xC0, 0x41, 0x80, 0x40, 0x80});
}

TEST_CASE("station: a full log fills D111 to D142, the newest event in the low byte of D111")
{
    station_bench b(std::string(server_1) + "H11 D8415, K100 D8416");
    for (unsigned i = 0; i < 40; ++i)
        b.ask(test::query);
    b.ask(test::bad_function);
    CHECK(b.word("D110") == 64);
    CHECK(b.word("D111") == 0x8041);
    for (unsigned i = 112; i <= 142; ++i)
        CHECK(b.word(("D" + std::to_string(i)).c_str()) == 0x8040);
    CHECK(b.word("D143") == 0);
    CHECK(b.word("D0") == 0);
}

TEST_CASE("station: STOP -> RUN clears what is shown at once, before anything is heard on the line")
{
    station_bench b(std::string(server_1) + "H11 D8415, K100 D8416");
    play_everything(b);
    b.plc.stop();
    CHECK(b.word("D111") == 0x8290);
    b.plc.run();
    for (unsigned i = 100; i <= 142; ++i)
        CHECK(b.word(("D" + std::to_string(i)).c_str()) == 0);
    b.ask(modbus::unit_id{2}, test::query);
    CHECK(b.word("D100") == 1);
    CHECK(b.word("D110") == 0);
}

TEST_CASE("station: counters alone, the log alone, in D or R, channel 1 or 2")
{
    struct {
        const char* name;
        std::string moves;
        unsigned channel;
        const char* counters;  // device of the bus message counter
        const char* log;       // device of the log's length
    } const rows[] = {
        {"counters in D", std::string(server_1) + "H1 D8415, K7990 D8416", 1, "D7990", nullptr},
        {"log in D", std::string(server_1) + "H10 D8415, K7967 D8416", 1, nullptr, "D7967"},
        {"both in D", std::string(server_1) + "H11 D8415, K7957 D8416", 1, "D7957", "D7967"},
        {"counters in R", std::string(server_1) + "H101 D8415, K32758 D8416", 1, "R32758", nullptr},
        {"log in R", std::string(server_1) + "H110 D8415, K32735 D8416", 1, nullptr, "R32735"},
        {"both in R", std::string(server_1) + "H111 D8415, K32725 D8416", 1, "R32725", "R32735"},
        {"both in R, at 0", std::string(server_1) + "H111 D8415, K0 D8416", 1, "R0", "R10"},
        {"unused bits", std::string(server_1) + "HFEFF D8415, K100 D8416", 1, "D100", "D110"},
        {"channel 2", std::string(server_2) + "H11 D8435, K200 D8436", 2, "D200", "D210"},
        {"not set up to be a server", "H11 D8415, K100 D8416", 1, "D100", "D110"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b(row.moves, plc::fx3u, row.channel);
        CHECK_FALSE(b.plc.fault().has_value());
        b.plc.memory().take_changes();
        b.ask(modbus::unit_id{2}, {0x07});
        b.ask({0x11});
        std::size_t changed = 0;
        for (const plc::change& each : b.plc.memory().take_changes())
            changed += each.count / 16;
        CHECK(changed == (row.counters ? 3U : 0U) + (row.log ? 2U : 0U));  // and nothing else was written
        if (row.counters) {
            CHECK(b.word(row.counters) == 2);
        }
        if (row.log) {
            CHECK(b.word(row.log) == 2);
            CHECK(b.plc.memory().word({b.at(row.log).area, b.at(row.log).bit + 16}) == 0x8040);
        }
    }
}

TEST_CASE("station: a client that writes into the shown counters does not change them")
{
    station_bench b(std::string(server_1) + "H1 D8415, K100 D8416");
    b.ask({0x06, 0x00, 0x64, 0x12, 0x34});
    CHECK(b.word("D100") == 1);
}

TEST_SUITE_END();
