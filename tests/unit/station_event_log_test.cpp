// The communication event log, byte by byte: FX3 manual 9.5, V1.1b3 section 6.10.
#include "tests/unit/station_bench.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using test::station_bench;

TEST_CASE("event log: keeps the newest 64, newest first")
{
    event_log log;
    CHECK(log.newest_first().empty());
    for (unsigned i = 0; i < 64; ++i)
        log.add(static_cast<std::uint8_t>(i));
    CHECK(log.size() == 64);
    CHECK(log[0] == 63);
    CHECK(log[63] == 0);
    log.add(200);
    CHECK(log.size() == 64);
    CHECK(log[0] == 200);
    CHECK(log[63] == 1);
    CHECK(log.registers()[0] == 64);
    CHECK(log.registers()[1] == 63 * 256 + 200);
    CHECK(log.registers()[32] == 1 * 256 + 2);
    log.clear();
    CHECK(log.size() == 0);
    CHECK(log.registers() == std::array<std::uint16_t, 33>{});
    log.add(7);
    log.add(8);
    log.add(9);
    CHECK(log.newest_first() == buffer{9, 8, 7});
    CHECK(log.registers()[0] == 3);
    CHECK(log.registers()[1] == 0x0809);
    CHECK(log.registers()[2] == 0x0007);
}

TEST_CASE("station: what comes into the event log")
{
    struct {
        const char* name;
        void (*play)(station_bench& b);
        buffer log;  // newest first
    } const rows[] = {
        {"nothing yet", [](station_bench&) {}, {}},
        {"request and response", [](station_bench& b) { b.ask(test::query); }, {0x40, 0x80}},
        {"exceptions 01, 02 and 03 are read exceptions",
         [](station_bench& b) {
             b.ask(test::bad_function);
             b.ask({0x03, 0xFF, 0xFF, 0x00, 0x01});
             b.ask({0x03, 0x00, 0x00, 0x00, 0x00});
         },
         {0x41, 0x80, 0x41, 0x80, 0x41, 0x80}},
        {"broadcast",
         [](station_bench& b) {
             b.tell_all({0x06, 0, 0, 0, 1});
         },
         {0xC0}},
        {"refused broadcast",
         [](station_bench& b) {
             b.tell_all({0x03, 0, 0, 0, 1});
         },
         {0xC0}},
        {"neighbours are not logged", [](station_bench& b) { b.ask(modbus::unit_id{2}, test::query); }, {}},
        {"damaged frame", [](station_bench& b) { b.station.bus_error(errc::bad_checksum); }, {0x82}},
        {"overrun", [](station_bench& b) { b.station.bus_error(errc::overlong); }, {0x90}},
        {"the response has not left yet",
         [](station_bench& b) {
             b.station.answer({modbus::unit_id{1}, test::query});
         },
         {0x80}},
        {"listen-only mode begins: no response, so no send event",
         [](station_bench& b) { b.ask(test::listen_only); },
         {0x04, 0x80}},
        {"listen-only mode by broadcast", [](station_bench& b) { b.tell_all(test::listen_only); }, {0x04, 0xC0}},
        {"in listen-only mode: requests, broadcasts, damage, overruns",
         [](station_bench& b) {
             b.ask(test::listen_only);
             b.ask(test::query);
             b.tell_all({0x06, 0, 0, 0, 1});
             b.ask(test::listen_only);
             b.station.bus_error(errc::bad_checksum);
             b.station.bus_error(errc::overlong);
         },
         {0xB0, 0xA2, 0xA0, 0xE0, 0xA0, 0x04, 0x80}},
        {"restart", [](station_bench& b) { b.ask(test::restart); }, {0x00, 0x40, 0x80}},
        {"restart by broadcast", [](station_bench& b) { b.tell_all(test::restart); }, {0x00, 0xC0}},
        {"restart and clear",
         [](station_bench& b) {
             b.ask(test::query);
             b.ask(test::restart_and_clear_log);
         },
         {0x00}},
        {"restart out of listen-only mode",
         [](station_bench& b) {
             b.ask(test::listen_only);
             b.ask(test::restart);
             b.ask(test::query);
         },
         {0x40, 0x80, 0x00, 0xA0, 0x04, 0x80}},
        {"restart by broadcast out of listen-only mode",
         [](station_bench& b) {
             b.ask(test::listen_only);
             b.tell_all(test::restart);
         },
         {0x00, 0xE0, 0x04, 0x80}},
        {"restart and clear out of listen-only mode",
         [](station_bench& b) {
             b.ask(test::listen_only);
             b.ask(test::restart_and_clear_log);
         },
         {0x00}},
        {"clearing the counters leaves the log",
         [](station_bench& b) {
             b.ask(test::query);
             b.ask(test::clear_counters);
         },
         {0x40, 0x80, 0x40, 0x80}},
        {"STOP leaves it",
         [](station_bench& b) {
             b.ask(test::query);
             b.plc.stop();
         },
         {0x40, 0x80}},
        {"STOP and RUN clear it",
         [](station_bench& b) {
             b.ask(test::query);
             b.plc.stop();
             b.plc.run();
         },
         {}},
        {"power clears it",
         [](station_bench& b) {
             b.ask(test::query);
             b.plc.power_cycle();
             b.ask(test::query);
         },
         {0x40, 0x80}},
        {"a reply cut off by a power cycle is forgotten",
         [](station_bench& b) {
             b.station.answer({modbus::unit_id{1}, test::restart});
             b.plc.power_cycle();
             b.station.sent();
         },
         {}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b;
        row.play(b);
        CHECK(b.log() == row.log);
    }
}

TEST_CASE("station: a whole story, read with function 0C: its own receive event is the newest")
{
    station_bench b;
    b.ask(test::query);                                    // 80 40
    b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01});            // C0
    b.station.bus_error(errc::bad_checksum);               // 82
    b.ask(test::bad_function);                             // 80 41
    b.ask(test::listen_only);                              // 80 04
    b.ask(test::query);                                    // A0
    b.ask(test::restart);                                  // A0 00, counters are 0
    CHECK(b.ask({0x0C}) == buffer{0x0C, 0x12, 0x00, 0x00,  // status
                                  0x00, 0x00,              // events
                                  0x00, 0x01,              // bus messages
                                  0x80, 0x00, 0xA0, 0xA0, 0x04, 0x80, 0x41, 0x80, 0x82, 0xC0, 0x40, 0x80});
    CHECK(b.ask({0x0C}) == buffer{0x0C, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x80, 0x40, 0x80,
                                  0x00, 0xA0, 0xA0, 0x04, 0x80, 0x41, 0x80, 0x82, 0xC0, 0x40, 0x80});
}

TEST_CASE("station: a full log is 64 events in the response")
{
    station_bench b;
    for (unsigned i = 0; i < 100; ++i)
        b.ask(test::query);
    const auto reply = b.ask({0x0C});
    REQUIRE(reply.has_value());
    REQUIRE(reply->size() == 72);
    CHECK(buffer(reply->begin(), reply->begin() + 10) ==
          buffer{0x0C, 0x46, 0x00, 0x00, 0x00, 0x64, 0x00, 0x65, 0x80, 0x40});
    CHECK(reply->back() == 0x40);
}

TEST_CASE("station: of more than 64 events the oldest go, byte for byte in function 0C and in D110-D142 (9.5.1)")
{
    station_bench b(std::string(test::server_1) + "H11 D8415, K100 D8416");
    buffer newest_first;
    const auto logged = [&](std::initializer_list<std::uint8_t> events) {
        for (const std::uint8_t each : events)
            newest_first.insert(newest_first.begin(), each);
    };
    for (unsigned i = 0; i < 120; ++i) {  // no run of 64 looks like another
        if (i % 7 == 0) {
            b.station.bus_error(errc::bad_checksum);
            logged({0x82});
        }
        if (i % 11 == 0) {
            b.station.bus_error(errc::overlong);
            logged({0x90});
        }
        if (i % 13 == 0) {
            b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01});
            logged({0xC0});
        }
        if (i % 5 == 0) {
            b.ask(test::bad_function);
            logged({0x80, 0x41});
        }
        const buffer shown(newest_first.begin(),
                           newest_first.begin() +
                               static_cast<std::ptrdiff_t>(std::min<std::size_t>(64, newest_first.size())));
        REQUIRE(b.log() == shown);
        REQUIRE(b.word("D110") == shown.size());
        for (std::size_t event = 0; event < shown.size(); ++event) {
            const std::uint16_t word = b.word(("D" + std::to_string(111 + event / 2)).c_str());
            REQUIRE((event % 2 == 0 ? word & 0xFF : word >> 8) == shown[event]);
        }
    }
    REQUIRE(newest_first.size() > 64);
    const auto reply = b.ask({0x0C});
    logged({0x80});  // function 0C itself, and the oldest of the 64 is gone
    REQUIRE(reply.has_value());
    REQUIRE(reply->size() == 8 + 64);
    CHECK((*reply)[1] == 6 + 64);
    CHECK(buffer(reply->begin() + 8, reply->end()) == buffer(newest_first.begin(), newest_first.begin() + 64));
}

TEST_SUITE_END();
