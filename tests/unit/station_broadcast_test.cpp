// Broadcasts: carried out, never answered, and only where the manual's column "Broadcast" (7.1) has a tick.
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using test::station_bench;
using words = std::vector<std::uint16_t>;

TEST_CASE("station: broadcasts that are carried out")
{
    struct {
        const char* name;
        buffer pdu;
        bool (*done)(station_bench& b);
    } const rows[] = {
        {"05", {0x05, 0x33, 0x08, 0xFF, 0x00}, [](station_bench& b) { return b.bit("Y10"); }},
        {"06", {0x06, 0x00, 0x07, 0x12, 0x34}, [](station_bench& b) { return b.word("D7") == 0x1234; }},
        {"0F", {0x0F, 0x00, 0x00, 0x00, 0x02, 0x01, 0x03}, [](station_bench& b) { return b.word("M0") == 3; }},
        {"10",
         {0x10, 0x00, 0x07, 0x00, 0x01, 0x02, 0x12, 0x34},
         [](station_bench& b) { return b.word("D7") == 0x1234; }},
        {"16", {0x16, 0x00, 0x07, 0x00, 0x00, 0x12, 0x34}, [](station_bench& b) { return b.word("D7") == 0x1234; }},
        {"08 03", {0x08, 0x00, 0x03, 0x23, 0x00}, [](station_bench& b) { return b.station.delimiter() == 0x23; }},
        {"08 04", {0x08, 0x00, 0x04, 0x00, 0x00}, [](station_bench& b) { return b.station.listen_only(); }},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b;
        CHECK_FALSE(b.tell_all(row.pdu));
        CHECK(row.done(b));
        CHECK(b.counters() == words{1, 0, 0, 1, 1, 0, 0, 0, 1});
        CHECK(b.word("D8402") == 0);
        CHECK_FALSE(b.bit("M8402"));
        CHECK(b.log().back() == 0xC0);
    }
    for (const buffer& pdu : {test::restart, test::restart_and_clear_log, test::clear_counters}) {  // 08 01, 08 0A
        station_bench b;
        b.ask(test::query);
        CHECK_FALSE(b.tell_all(pdu));
        CHECK(b.counters() == words(9));
        CHECK(b.word("D8402") == 0);
    }
}

TEST_CASE("station: broadcasts that are refused: error 215, counted as an exception, nothing sent, nothing done")
{
    struct {
        const char* name;
        buffer pdu;
        std::uint16_t detail;
    } const rows[] = {
        {"01", {0x01, 0x00, 0x00, 0x00, 0x01}, 0x0001},
        {"02", {0x02, 0x00, 0x00, 0x00, 0x01}, 0x0002},
        {"03", {0x03, 0x00, 0x00, 0x00, 0x01}, 0x0003},
        {"04", {0x04, 0x00, 0x00, 0x00, 0x01}, 0x0004},
        {"07", {0x07}, 0x0007},
        {"0B", {0x0B}, 0x000B},
        {"0C", {0x0C}, 0x000C},
        {"11", {0x11}, 0x0011},
        {"17", {0x17, 0, 0, 0, 1, 0, 7, 0, 1, 2, 0x12, 0x34}, 0x0017},
        {"08 00", {0x08, 0x00, 0x00, 0x12, 0x34}, 0x0800},
        {"08 02", {0x08, 0x00, 0x02, 0x00, 0x00}, 0x0802},
        {"08 0B", {0x08, 0x00, 0x0B, 0x00, 0x00}, 0x080B},
        {"08 0C", {0x08, 0x00, 0x0C, 0x00, 0x00}, 0x080C},
        {"08 0D", {0x08, 0x00, 0x0D, 0x00, 0x00}, 0x080D},
        {"08 0E", {0x08, 0x00, 0x0E, 0x00, 0x00}, 0x080E},
        {"08 0F", {0x08, 0x00, 0x0F, 0x00, 0x00}, 0x080F},
        {"08 10", {0x08, 0x00, 0x10, 0x00, 0x00}, 0x0810},
        {"08 11", {0x08, 0x00, 0x11, 0x00, 0x00}, 0x0811},
        {"08 12", {0x08, 0x00, 0x12, 0x00, 0x00}, 0x0812},
        {"before the count is looked at", {0x03, 0x00, 0x00, 0x00, 0x00}, 0x0003},
        {"before the value is looked at", {0x08, 0x00, 0x02, 0x12, 0x34}, 0x0802},
    };
    for (const auto& row : rows) {
        for (const unsigned channel : {1U, 2U}) {
            CAPTURE(row.name);
            CAPTURE(channel);
            station_bench b("", plc::fx3u, channel);
            CHECK_FALSE(b.tell_all(row.pdu));
            CHECK(b.word(channel == 1 ? "D8402" : "D8422") == 215);
            CHECK(b.word(channel == 1 ? "D8403" : "D8423") == row.detail);
            CHECK(b.bit(channel == 1 ? "M8402" : "M8422"));
            CHECK(b.counters() == words{1, 0, 1, 1, 1, 0, 0, 0, 0});
            CHECK(b.log() == buffer{0xC0});
            CHECK(b.word("D7") == 0);
        }
    }
}

TEST_CASE("station: a broadcast's exceptions are noted, not sent")
{
    struct {
        const char* name;
        buffer pdu;
        std::uint16_t error;
    } const rows[] = {
        {"unknown function", {0x55, 0x00}, 209},
        {"unknown sub-function", {0x08, 0x00, 0x05, 0x00, 0x00}, 209},
        {"length", {0x06, 0x00, 0x00, 0x00}, 207},
        {"no sub-function", {0x08}, 207},
        {"value", {0x05, 0x00, 0x00, 0x00, 0x01}, 216},
        {"value of a diagnostic", {0x08, 0x00, 0x0A, 0x00, 0x01}, 216},
        {"address", {0x06, 0xFF, 0xFF, 0x00, 0x01}, 210},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b;
        CHECK_FALSE(b.tell_all(row.pdu));
        CHECK(b.word("D8402") == row.error);
        CHECK(b.word("D8403") == 0);
        CHECK(b.counters() == words{1, 0, 1, 1, 1, 0, 0, 0, 0});
        CHECK(b.log() == buffer{0xC0});
    }
}

TEST_CASE("station: on the small models a broadcast of function 16 is unknown, not refused")
{
    station_bench b("", plc::fx3g);
    CHECK_FALSE(b.tell_all({0x16, 0x00, 0x07, 0x00, 0x00, 0x12, 0x34}));
    CHECK(b.word("D8402") == 209);
    CHECK_FALSE(b.tell_all({0x03, 0x00, 0x00, 0x00, 0x01}));
    CHECK(b.word("D8402") == 215);
    CHECK_FALSE(b.tell_all({0x06, 0x00, 0x07, 0x12, 0x34}));
    CHECK(b.word("D7") == 0x1234);
}

TEST_SUITE_END();
