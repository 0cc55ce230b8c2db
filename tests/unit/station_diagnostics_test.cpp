// Functions 07 and 08: the diagnostic register, the delimiter, listen-only mode and the restart. FX3 manual 7.10
// and 7.11.
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using test::station_bench;

TEST_CASE("station: exception status and diagnostic register are M8060-M8067, M8438 in place of M8063 on channel 2")
{
    for (unsigned i = 0; i < 8; ++i) {
        CAPTURE(i);
        const std::string flag = "M" + std::to_string(8060 + i);
        const auto byte = static_cast<std::uint8_t>(1U << i);

        station_bench one;
        one.set_bit(flag.c_str(), true);
        one.set_bit("M8438", true);
        CHECK(one.ask({0x07}) == buffer{0x07, byte});
        CHECK(one.ask({0x08, 0x00, 0x02, 0x00, 0x00}) == buffer{0x08, 0x00, 0x02, 0x00, byte});

        station_bench two("", plc::fx3u, 2);
        two.set_bit(flag.c_str(), true);
        CHECK(two.ask({0x07}) == buffer{0x07, i == 3 ? std::uint8_t{0} : byte});
        two.set_bit("M8438", true);
        CHECK(two.ask({0x07}) == buffer{0x07, static_cast<std::uint8_t>(byte | 0x08)});
    }
}

TEST_CASE("station: an error shows in the diagnostic register of its own channel")
{
    station_bench one;
    one.ask(test::bad_function);
    CHECK(one.ask({0x07}) == buffer{0x07, 0x08});
    station_bench two("", plc::fx3u, 2);
    two.ask(test::bad_function);
    CHECK(two.ask({0x07}) == buffer{0x07, 0x08});
    CHECK_FALSE(two.bit("M8063"));
}

TEST_CASE("station: clearing the counters leaves the error flags in the diagnostic register (7.11.6)")
{
    station_bench b;
    b.ask(test::bad_function);
    CHECK(b.ask(test::clear_counters) == test::clear_counters);
    CHECK(b.ask({0x08, 0x00, 0x02, 0x00, 0x00}) == buffer{0x08, 0x00, 0x02, 0x00, 0x08});
    CHECK(b.word("D8402") == 209);
    b.set_bit("M8063", false);  // the program, or a monitoring device
    CHECK(b.ask({0x08, 0x00, 0x02, 0x00, 0x00}) == buffer{0x08, 0x00, 0x02, 0x00, 0x00});
}

TEST_CASE("station: a new delimiter is in force when the response has left, and stays until power-on")
{
    for (const unsigned channel : {1U, 2U}) {
        station_bench b("", plc::fx3u, channel);
        const char* const shown = channel == 1 ? "D8406" : "D8426";
        CHECK(b.station.delimiter() == 0x0A);
        CHECK(b.word(shown) == 0x000A);

        b.station.bus_message();
        const auto reply = b.station.answer({modbus::unit_id{1}, {0x08, 0x00, 0x03, 0x23, 0x00}});
        CHECK(reply == buffer{0x08, 0x00, 0x03, 0x23, 0x00});
        CHECK(b.station.delimiter() == 0x0A);  // the response itself still ends with LF
        CHECK(b.word(shown) == 0x000A);
        b.station.sent();
        CHECK(b.station.delimiter() == 0x23);
        CHECK(b.word(shown) == 0x0023);

        b.plc.stop();
        b.plc.run();
        b.ask(test::restart);
        CHECK(b.station.delimiter() == 0x23);
        b.set(shown, 0x41);  // read only for a server: the register is a display
        CHECK(b.station.delimiter() == 0x23);
        b.plc.power_cycle();
        CHECK(b.station.delimiter() == 0x0A);
        CHECK(b.word(shown) == 0x000A);
    }
}

TEST_CASE("station: a delimiter by broadcast is in force at once, and any of 00 to FF is taken")
{
    for (const unsigned character : {0x00U, 0x0AU, 0x30U, 0x3AU, 0x46U, 0xFFU}) {
        station_bench b;
        CHECK_FALSE(b.tell_all({0x08, 0x00, 0x03, static_cast<std::uint8_t>(character), 0x00}));
        CHECK(b.station.delimiter() == character);
        CHECK(b.word("D8406") == character);
    }
}

TEST_CASE("station: a reply that never left does not lose its effect")
{
    station_bench b;
    b.station.answer({modbus::unit_id{1}, {0x08, 0x00, 0x03, 0x23, 0x00}});
    b.ask({0x07});
    CHECK(b.station.delimiter() == 0x23);
    CHECK(b.log() == buffer{0x40, 0x80, 0x80});  // but it was not sent
    b.station.sent();                            // and nothing is sent twice
    CHECK(b.log() == buffer{0x40, 0x80, 0x80});
}

TEST_CASE("station: in listen-only mode nothing is answered and nothing is done")
{
    for (const unsigned channel : {1U, 2U}) {
        station_bench b("", plc::fx3u, channel);
        const char* const flag = channel == 1 ? "M8404" : "M8424";
        CHECK_FALSE(b.bit(flag));
        CHECK_FALSE(b.ask(test::listen_only));
        CHECK(b.bit(flag));
        CHECK(b.station.listen_only());

        const buffer requests[] = {{0x03, 0x00, 0x00, 0x00, 0x01},
                                   {0x06, 0x00, 0x00, 0x12, 0x34},
                                   {0x05, 0x00, 0x00, 0xFF, 0x00},
                                   {0x08, 0x00, 0x03, 0x23, 0x00},
                                   {0x08, 0x00, 0x0A, 0x00, 0x00},
                                   {0x08, 0x00, 0x01, 0x12, 0x34},  // no restart: its data is wrong
                                   {0x08, 0x00, 0x01},
                                   {0x0B},
                                   {0x11},
                                   test::listen_only,
                                   test::bad_function};
        for (const buffer& request : requests) {
            CHECK_FALSE(b.ask(request));
            CHECK_FALSE(b.tell_all(request));
        }
        CHECK(b.word("D0") == 0);
        CHECK_FALSE(b.bit("M0"));
        CHECK(b.station.delimiter() == 0x0A);
        CHECK(b.word(channel == 1 ? "D8402" : "D8422") == 0);
        CHECK(b.station.listen_only());

        b.plc.stop();
        b.plc.run();  // not one of its ways back
        CHECK(b.station.listen_only());
        CHECK(b.bit(flag));
    }
}

TEST_CASE("station: a restart ends listen-only mode without a response, the next request is answered")
{
    for (const buffer& how : {test::restart, test::restart_and_clear_log}) {
        station_bench b;
        b.ask(test::listen_only);
        CHECK_FALSE(b.ask(how));
        CHECK_FALSE(b.station.listen_only());
        CHECK_FALSE(b.bit("M8404"));
        CHECK(b.ask(test::query) == test::query);

        b.ask(test::listen_only);
        CHECK_FALSE(b.tell_all(how));  // by broadcast too
        CHECK_FALSE(b.bit("M8404"));
        CHECK(b.ask(test::query) == test::query);
    }
    station_bench b;
    b.ask(test::listen_only);
    CHECK_FALSE(b.ask(modbus::unit_id{2}, test::restart));  // somebody else's
    CHECK(b.station.listen_only());
    b.plc.power_cycle();
    CHECK_FALSE(b.station.listen_only());
    CHECK_FALSE(b.bit("M8404"));
    CHECK(b.ask(test::query) == test::query);
}

TEST_CASE("station: a restart outside listen-only mode happens when its response has left")
{
    station_bench b;
    b.ask(test::query);
    b.ask(test::bad_function);
    b.station.bus_message();
    CHECK(b.station.answer({modbus::unit_id{1}, test::restart}) == test::restart);
    CHECK(b.counters() == std::vector<std::uint16_t>{3, 0, 1, 3, 0, 0, 0, 0, 2});
    b.station.sent();
    CHECK(b.counters() == std::vector<std::uint16_t>(9));
    CHECK(b.word("D8402") == 209);  // error code and flags are not the restart's business
    CHECK(b.bit("M8403"));
}

TEST_SUITE_END();
