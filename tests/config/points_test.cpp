// Points, and what routes say beside their way.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// A plant with one station, some routes, and rows to be judged on lines of their own.
std::string text_with(std::string_view routes, std::string_view points, std::string_view station = "")
{
    return fmt::format(R"({{"plcs": [{{"name": "main"}}, {{"name": "other"}}],
"lines": [{{"name": "l", "device": "/dev/ttyS0"}}],
"stations": [{{"name": "s", "line": "l", "unit": 1{}}}],
"routes": [
{{"name": "in", "station": "s", "table": "holding", "first": 0, "count": 4, "plc": "main", "device": "D100"}},
{{"name": "both", "station": "s", "table": "holding", "first": 10, "count": 2, "plc": "main", "device": "D110",
  "direction": "read-write"}},
{{"name": "out", "station": "s", "table": "holding", "first": 20, "count": 2, "plc": "main", "device": "D120",
  "direction": "write"}}{}],
"points": [
{}]}})",
                       station, routes, points);
}

std::string said_of_point(std::string_view row)
{
    return said(text_with("", fmt::format(R"({{"name": "p", "plc": "main", {}}})", row)));
}

std::string said_of_route(std::string_view row)
{
    return said(text_with(fmt::format(",\n{{\"name\": \"r\", {}}}", row), ""));
}

struct judged {
    std::string_view row;
    std::string_view expected;
};

}  // namespace

TEST_CASE("check: points")
{
    const judged rows[] = {
        {R"("device": "D100")", ""},
        {R"("device": "D102", "type": "float", "order": "CDAB", "unit": "Cel", "min": 0, "max": 100, "deadband_percent": 1)",
         ""},
        {R"("device": "M5", "type": "bool")", ""},
        {R"("device": "D5", "type": "bool", "bit": 15, "writable": true)", ""},
        {R"("device": "D110", "type": "uint32", "writable": true)", ""},
        {R"("device": "D120", "type": "double")", ""},
        {R"("device": "D200", "type": "text", "characters": 9, "order": "BADC")", ""},

        {R"("device": "Z1")", R"(11 /points/0/device is "Z1", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "D7999", "type": "int32")",
         "11 /points/0/device is D7999, but from there the count goes beyond D7999, the last one"},
        {R"("device": "D5", "type": "bool")", R"(11 /points/0 lacks "bit": which one of the word, 0 = lowest)"},
        {R"("device": "M5", "type": "bool", "bit": 0)", "11 /points/0/bit stands at a device that is a bit itself"},
        {R"("device": "D5", "bit": 0)", "11 /points/0/bit belongs to the type bool"},
        {R"("device": "D5", "type": "text")", R"(11 /points/0 lacks "characters": a text needs room)"},
        {R"("device": "D5", "characters": 3)", "11 /points/0/characters belongs to the type text"},
        {R"("device": "D5", "type": "text", "characters": 3, "order": "CDAB")",
         "11 /points/0/order turns registers round, but a text knows only ABCD, first character in the high byte, and "
         "BADC, in the low byte"},
        {R"("device": "D5", "scale": 0)", "11 /points/0/scale is 0: every value would be the offset"},
        {R"("device": "M5", "type": "bool", "max": 1)", "11 /points/0/max belongs to numbers: a text or bool has none"},
        {R"("device": "D5", "min": 3, "max": 2)", R"(11 /points/0/min is above "max")"},
        {R"("device": "D5", "max": 2, "deadband_percent": 1)",
         R"(11 /points/0/deadband_percent is a part of the span from "min" to "max": give both)"},
        {R"("device": "D5", "min": 1, "max": 2, "deadband": 1, "deadband_percent": 1)",
         R"(11 /points/0/deadband_percent stands beside "deadband": give one of them)"},
        {R"("device": "D103", "type": "int32")",
         "11 /points/0/device lies only partly in the devices of route \"in\": its registers would come at different "
         "times, and the value could be torn. Let one route fill all of them"},
        {R"("device": "D100", "writable": true)",
         "11 /points/0/writable is true, but route \"in\" fills these devices and would undo each write: a route of "
         "direction read-write takes it to the station"},
        {R"("device": "D121", "type": "int32", "writable": true)",
         "11 /points/0/device lies only partly in the devices of route \"out\": it would be written in two requests, "
         "and "
         "could be torn. Let one route write all of it"},
        {R"("device": "D5", "scale": "1")", R"(11 /points/0/scale is "1", expected a number from -1e+30 to 1e+30)"},
        {R"("device": "D5", "order": "abcd")",
         R"(11 /points/0/order is "abcd", expected one of: ABCD, CDAB, BADC, DCBA)"},
    };
    for (const judged& row : rows) {
        INFO(std::string(row.row));
        CHECK(said_of_point(row.row) == row.expected);
    }
    CHECK(said(text_with("", R"({"name": "p", "plc": "main", "device": "D0"},
{"name": "p", "plc": "main", "device": "D1"})")) == "12 /points/1/name \"p\" stands twice: give each its own name");
}

TEST_CASE("check: directions")
{
    const judged rows[] = {
        {R"("station": "s", "table": "input", "first": 0, "plc": "main", "device": "D0", "direction": "read-write")",
         "10 /routes/3/table is read-only in MODBUS: a write route needs coil or holding"},
        {R"("station": "s", "table": "holding", "first": 0, "count": 124, "plc": "main", "device": "D0",
"direction": "periodic-write")",
         "10 /routes/3/count is 124, but one MODBUS request carries 123: split the route"},
        {R"("station": "s", "table": "coil", "first": 0, "plc": "main", "device": "D110", "direction": "read-write")",
         "10 /routes/3/device overlaps with the devices of route \"both\": each device has one source"},
    };
    for (const judged& row : rows) {
        INFO(std::string(row.row));
        CHECK(said_of_route(row.row) == row.expected);
    }
}

TEST_CASE("check: loss, status and upstream of a route")
{
    const std::string in =
        R"("station": "s", "table": "holding", "first": 0, "count": 3, "plc": "main", "device": "D0", )";
    const std::string out = in + R"("direction": "write", )";
    const struct {
        std::string row;
        std::string_view expected;
    } rows[] = {
        {in + R"("on_loss": "zero")", ""},
        {in + R"("on_loss": "value", "loss_value": [7])", ""},
        {in + R"("on_loss": "value", "loss_value": [1, 2, 3])", ""},
        {in + R"("status": {"device": "D500"})", ""},
        {in + R"("status": {"plc": "other", "device": "D500", "order": "CDAB"})", ""},
        {out + R"("upstream": {"longest_silence_ms": 5000, "safe": [0]})", ""},

        {out + R"("on_loss": "zero")", "10 /routes/3/on_loss stands at a route that only writes: its memory is the "
                                       "writer's, there is nothing to lose"},
        {in + R"("on_loss": "value")",
         "10 /routes/3/loss_value is missing: one value for all registers or bits, or one for each"},
        {in + R"("on_loss": "value", "loss_value": [1, 2])",
         "10 /routes/3/loss_value has 2 values, expected one, or one for each of the 3"},
        {in + R"("loss_value": [1])", R"(10 /routes/3/loss_value does nothing without "on_loss": "value")"},
        {R"("station": "s", "table": "coil", "first": 0, "plc": "main", "device": "M0", "on_loss": "value",
"loss_value": [2])",
         "11 /routes/3/loss_value is for bits: give 0 or 1"},
        {in + R"("status": {"plc": "other"})", R"(10 /routes/3/status lacks "device": the first of the status words)"},
        {in + R"("status": {"device": "D96"})",
         "10 /routes/3/status/device overlaps with the devices of route \"in\": each device has one source"},
        {in + R"("status": {"device": "D7995"})",
         "10 /routes/3/status/device is D7995, but from there the count goes beyond D7999, the last one"},
        {in + R"("upstream": {"longest_silence_ms": 5000, "safe": [0]})",
         R"(10 /routes/3/upstream stands at a route that reads: safe values are for "write" and "periodic-write")"},
        {out + R"("upstream": {"longest_silence_ms": 5000})",
         "10 /routes/3/upstream/safe is missing: one value for all registers or bits, or one for each"},
        {out + R"("upstream": {"safe": [0]})",
         R"(10 /routes/3/upstream/safe does nothing without "longest_silence_ms")"},
    };
    for (const auto& row : rows) {
        INFO(row.row);
        CHECK(said_of_route(row.row) == row.expected);
    }
    CHECK(said(text_with("", "", R"(, "status": {"plc": "other", "device": "D0"})")) == "");
    CHECK(said(text_with("", "", R"(, "status": {"device": "D0"})")) ==
          "3 /stations/0/status lacks \"plc\": the PLC that shows it");
    CHECK(said(text_with("", "", R"(, "status": {"plc": "main", "device": "D101"})")) ==
          "3 /stations/0/status/device overlaps with the devices of route \"in\": each device has one source");
}

TEST_CASE("check: routes from PLC to PLC")
{
    const judged rows[] = {
        {R"("from": {"plc": "main", "device": "D100"}, "count": 4, "plc": "other", "device": "D0")", ""},
        {R"("from": {"plc": "main", "device": "M0"}, "count": 20, "plc": "other", "device": "D0")", ""},
        {R"("plc": "other", "device": "D0")",
         R"(10 /routes/3 lacks "station": the name of a station, or "from": devices of a PLC)"},
        {R"("from": {"plc": "main"}, "plc": "other", "device": "D0")",
         R"(10 /routes/3/from lacks "device": "from" needs a PLC and its first device)"},
        {R"("from": {"plc": "mian", "device": "D0"}, "plc": "other", "device": "D0")",
         R"(10 /routes/3/from/plc names the PLC "mian", which does not exist: did you mean "main"?)"},
        {R"("from": {"plc": "main", "device": "D0"}, "station": "s", "plc": "other", "device": "D0")",
         "10 /routes/3/station stands beside \"from\": devices of a PLC are copied when they change, and need nothing "
         "else"},
        {R"("from": {"plc": "main", "device": "D0"}, "plc": "main", "device": "D103")",
         "10 /routes/3/device overlaps with the devices of route \"in\": each device has one source"},
        {R"("from": {"plc": "main", "device": "D0"}, "plc": "main", "device": "D0")",
         "10 /routes/3/device is where the copy comes from"},
        // There and back to the same devices ends by itself.
        {R"("from": {"plc": "main", "device": "D0"}, "count": 9, "plc": "other", "device": "D50"},
{"name": "back", "from": {"plc": "other", "device": "D50"}, "count": 9, "plc": "main", "device": "D0")",
         ""},
        {R"("from": {"plc": "main", "device": "D0"}, "count": 9, "plc": "other", "device": "D50"},
{"name": "back", "from": {"plc": "other", "device": "D50"}, "count": 9, "plc": "main", "device": "D1")",
         "10 /routes/3/from is copied in a circle that comes back to other devices: each change would go on for ever\n"
         "11 /routes/4/from is copied in a circle that comes back to other devices: each change would go on for ever"},
        {R"("from": {"plc": "main", "device": "D0"}, "count": 2, "plc": "main", "device": "D1")",
         "10 /routes/3/from is copied in a circle that comes back to other devices: each change would go on for ever"},
        // Two that exchange two words: never at rest.
        {R"("from": {"plc": "main", "device": "D0"}, "count": 2, "plc": "other", "device": "D0"},
{"name": "b", "from": {"plc": "other", "device": "D0"}, "plc": "main", "device": "D1"},
{"name": "c", "from": {"plc": "other", "device": "D1"}, "plc": "main", "device": "D0")",
         "10 /routes/3/from is copied in a circle that comes back to other devices: each change would go on for ever"},
    };
    for (const judged& row : rows) {
        INFO(std::string(row.row));
        CHECK(said_of_route(row.row) == row.expected);
    }
}

TEST_SUITE_END();
