// Stations and routes on MEWTOCOL lines.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

std::string route(const std::string& keys, const std::string& protocol = "mewtocol-com", const std::string& unit = "7")
{
    return R"({"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "d", "protocol": ")" + protocol + R"("}],
"stations": [{"name": "s", "line": "l", "unit": )" +
           unit + R"(}],
"routes": [{"name": "r", "station": "s", "plc": "a", )" +
           keys + "}]}";
}

}  // namespace

TEST_CASE("check: points of MEWTOCOL routes of several commands")
{
    const auto with_point = [](const std::string& keys, const std::string& point, const char* line = "") {
        return R"({"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "d", "protocol": "mewtocol-com")" +
               std::string(line) + R"(}],
"stations": [{"name": "s", "line": "l", "unit": 7}],
"routes": [{"name": "r", "station": "s", "plc": "a", "device": "D0", "source": "DT0", )" +
               keys + R"(}],
"points": [
{"name": "p", "plc": "a", )" +
               point + "}]}";
    };
    const std::string normal = R"(, "mewtocol": {"expansion": false})";
    const char* const torn =
        "5 /points/0/device lies on both sides of the place where route \"r\" is cut into commands, ";
    const char* const cure = " at different times, and the value could be torn. Split the route so that a route begins "
                             "with the point";
    const struct {
        std::string text;
        std::string expected;
    } rows[] = {
        {with_point(R"("count": 509)", R"("device": "D507", "type": "int32")"), ""},
        {with_point(R"("count": 600)", R"("device": "D506", "type": "int32")"), ""},
        {with_point(R"("count": 600)", R"("device": "D508", "type": "int32")"), ""},
        {with_point(R"("count": 600)", R"("device": "D508", "type": "int16")"), ""},
        {with_point(R"("count": 600)", R"("device": "D507", "type": "int32")"),
         torn + std::string("508 words behind its first: its registers are read") + cure},
        {with_point(R"("count": 60)", R"("device": "D25", "type": "float")", normal.c_str()),
         torn + std::string("26 words behind its first: its registers are read") + cure},
        {with_point(R"("count": 60)", R"("device": "D25", "type": "float")"), ""},
        {with_point(R"("count": 30, "direction": "write")", R"("device": "D23", "type": "float", "writable": true)",
                    normal.c_str()),
         torn + std::string("24 words behind its first: its registers are written") + cure},
        {with_point(R"("count": 30, "direction": "write")", R"("device": "D23", "type": "float")", normal.c_str()), ""},
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        CHECK(said(row.text) == row.expected);
    }
}

TEST_CASE("check: sources of MEWTOCOL routes")
{
    const struct {
        const char* keys;
        const char* expected;
    } rows[] = {
        {R"("device": "D0", "source": "DT100", "count": 1024)", ""},
        {R"("device": "M0", "source": "R1F", "count": 1000)", ""},
        {R"("device": "D0", "source": "WR3", "direction": "write")", ""},
        {R"("device": "D0", "source": "SV5")", ""},
        {R"("device": "M0", "source": "T5", "count": 128)", ""},
        {R"("device": "M0", "source": "Y10", "count": 3, "direction": "write")", ""},
        {R"("device": "D0", "source": "DT100", "count": 1025)",
         "3 /routes/0/count is 1025, but a route carries 1024 words: split it"},
        {R"("device": "M0", "source": "T5", "count": 129)",
         "3 /routes/0/count is 129, but a route carries 128 contacts of timers or counters: split it"},
        {R"("device": "D0", "source": "D100")",
         "3 /routes/0/source is \"D100\", expected a device such as DT100, LD5, WR3, R1F (word 1, bit F) or T12"},
        {R"("device": "D0", "source": "DT99999", "count": 2)",
         "3 /routes/0/source is DT99999, but from there the count goes beyond what MEWTOCOL-COM can address"},
        {R"("device": "M0", "source": "X10", "direction": "write")",
         "3 /routes/0/source is X10, which MEWTOCOL-COM cannot write"},
        {R"("device": "D0", "source": "WX10", "direction": "write")",
         "3 /routes/0/source is WX10, which MEWTOCOL-COM cannot write"},
        {R"("device": "D0")",
         "3 /routes/0 lacks \"source\": the first device in its MEWTOCOL station, for example DT100"},
        {R"("device": "D0", "table": "holding", "first": 0)",
         "3 /routes/0/table belongs to MODBUS, but the station's line speaks MEWTOCOL: give \"source\", for example "
         "DT100\n"
         "3 /routes/0 lacks \"source\": the first device in its MEWTOCOL station, for example DT100"},
        {R"("device": "D0", "source": "DT1", "first": 0)",
         "3 /routes/0/first belongs to MODBUS, but the station's line speaks MEWTOCOL: give \"source\", for example "
         "DT100"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.keys));
        CHECK(said(route(row.keys)) == row.expected);
    }
}

TEST_CASE("check: sources of MEWTOCOL7 routes are words")
{
    const struct {
        const char* keys;
        const char* expected;
    } rows[] = {
        {R"("device": "D0", "source": "DT99999", "count": 1000)", ""},
        {R"("device": "M0", "source": "R1F", "count": 3)", ""},
        {R"("device": "M0", "source": "R20", "count": 16, "direction": "write")", ""},
        {R"("device": "M0", "source": "R20", "direction": "write")",
         "3 /routes/0/source is R20, but MEWTOCOL7-COM writes contacts as whole words: begin at bit 0 and give "
         "\"count\" "
         "a multiple of 16, or write the words"},
        {R"("device": "M0", "source": "T5")", "3 /routes/0/source is T5, which MEWTOCOL7-COM cannot read"},
        {R"("device": "D0", "source": "SV5")", "3 /routes/0/source is SV5, which MEWTOCOL7-COM cannot read"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.keys));
        CHECK(said(route(row.keys, "mewtocol7-com", "500")) == row.expected);
    }
}

TEST_CASE("check: a MODBUS route with a source, or without its address")
{
    CHECK(said(route(R"("device": "D0", "source": "DT1", "table": "holding", "first": 1)", "modbus-rtu")) ==
          "3 /routes/0/source belongs to MEWTOCOL, but the station's line speaks MODBUS: give \"table\" and \"first\"");
    CHECK(said(route(R"("device": "D0")", "modbus-rtu")) ==
          "3 /routes/0 lacks \"table\": where the values are in its MODBUS station\n"
          "3 /routes/0 lacks \"first\": the address of the first one in its MODBUS station");
}

TEST_CASE("check: numbers of stations")
{
    const char* const write = R"("device": "D0", "source": "DT1", "direction": "write")";
    CHECK(said(route(write, "mewtocol-com", "99")) == "");
    CHECK(said(route(write, "mewtocol-com", "0")) == "");
    CHECK(said(route(write, "mewtocol7-com", "999")) == "");
    CHECK(said(route(write, "mewtocol-com", "100")) == "2 /stations/0/unit is 100, but numbers on this line end at 99");
    CHECK(said(route(write, "mewtocol7-com", "0")) ==
          "2 /stations/0/unit is 0, but MEWTOCOL7-COM cannot speak to all stations");
    CHECK(said(route(R"("device": "D0", "source": "DT1")", "mewtocol-com", "0")) ==
          "3 /routes/0/station is unit 0, the broadcast: nobody answers, only write routes can use it");
    CHECK(said(route(R"("device": "D0", "table": "holding", "first": 1)", "modbus-rtu", "248")) ==
          "2 /stations/0/unit is 248, but numbers on this line end at 247");
}

TEST_SUITE_END();
