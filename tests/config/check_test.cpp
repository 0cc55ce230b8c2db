// Mistakes that no single value shows.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

TEST_CASE("check: names that lead nowhere")
{
    const change_row rows[] = {
        {R"("line": "south")", R"("line": "sout")",
         R"(33 /stations/2/line names the line "sout", which does not exist: did you mean "south"?)"},
        {R"("line": "south")", R"("line": "SOUTH")",
         R"(33 /stations/2/line names the line "SOUTH", which does not exist: did you mean "south"?)"},
        {R"("line": "south")", R"("line": "ethernet")",
         R"(33 /stations/2/line names the line "ethernet", which does not exist: add it)"},
        {R"("station": "meter")", R"("station": "metre")",
         R"(53 /routes/2/station names the station "metre", which does not exist: did you mean "meter"?)"},
        {R"("plc": "main",
      "device": "X10")",
         R"("plc": "mian",
      "device": "X10")",
         R"(57 /routes/2/plc names the PLC "mian", which does not exist: did you mean "main"?)"},
        {R"("other_units": "spare")", R"("other_units": "spar")",
         R"(69 /modbus_tcp/1/other_units names the PLC "spar", which does not exist: did you mean "spare"?)"},
        {R"("unit": 2, "plc": "spare")", R"("unit": 2, "plc": "third")",
         R"(65 /modbus_tcp/0/units/1/plc names the PLC "third", which does not exist: add it)"},
        {R"("plc": "main", "device": "M0")", R"("plc": "mains", "device": "M0")",
         R"(76 /dds/blocks/1/plc names the PLC "mains", which does not exist: did you mean "main"?)"},
        {R"("name": "meter",)", R"("name": "meter2",)",
         R"(53 /routes/2/station names the station "meter", which does not exist: did you mean "meter2"?)"},
    };
    for (const change_row& row : rows)
        check_row(row);
    CHECK(said(R"({"modbus_tcp": [{"other_units": "main"}]})") ==
          "1 /modbus_tcp/0/other_units names the PLC \"main\", which does not exist: add it");
}

TEST_CASE("check: things that stand twice")
{
    const change_row rows[] = {
        {R"("name": "spare")", R"("name": "main")",
         "11 /plcs/1/name \"main\" stands twice: give each its own name\n"
         "65 /modbus_tcp/0/units/1/plc names the PLC \"spare\", which does not exist: add it\n"
         "69 /modbus_tcp/1/other_units names the PLC \"spare\", which does not exist: add it"},
        {R"("name": "south",
      "device": "/dev/ttyUSB1")",
         R"("name": "south", "device": "/dev/ttyUSB1" },
    { "name": "south", "device": "/dev/ttyUSB2")",
         "22 /lines/2/name \"south\" stands twice: give each its own name"},
        {R"("name": "everyone")", R"("name": "pump")",
         "29 /stations/1/name \"pump\" stands twice: give each its own name\n"
         "46 /routes/1/station names the station \"everyone\", which does not exist: add it"},
        {R"("name": "meter.state")", R"("name": "pump.values")",
         "52 /routes/2/name \"pump.values\" stands twice: give each its own name"},
        {R"("unit": 0 })", R"("unit": 1 })",
         R"(31 /stations/1/unit is already the unit id of station "pump" on the same line)"},
        {R"("unit": 2, "plc": "spare")", R"("unit": 1, "plc": "spare")",
         "65 /modbus_tcp/0/units/1/unit stands twice: a unit id leads to one place"},
        {R"("device": "/dev/ttyUSB1")", R"("device": "/dev/ttyUSB0")",
         R"(22 /lines/1/device is already the device of line "north": a port belongs to one line)"},
        {R"("device": "/dev/ttyUSB1")", R"("device": "/dev/./serial/..//ttyUSB0")",
         R"(22 /lines/1/device is already the device of line "north": a port belongs to one line)"},
        // The same name for different things is none of our business, nor is a unit id on two lines.
        {R"("name": "meter",
      "line": "south",
      "unit": 1 })",
         R"("name": "meter", "line": "south", "unit": 1 }, { "name": "main", "line": "south", "unit": 2 })", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: devices of a route")
{
    const change_row rows[] = {
        {R"("device": "D100")", R"("device": "Z100")",
         R"(43 /routes/0/device is "Z100", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "D100")", R"("device": "D-1")",
         R"(43 /routes/0/device is "D-1", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "D100")", R"("device": "D100.0")",
         R"(43 /routes/0/device is "D100.0", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "X10")", R"("device": "X8")",
         R"(58 /routes/2/device is "X8", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "X10")", R"("device": "Y19")",
         R"(58 /routes/2/device is "Y19", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "X10")", R"("device": "X400")", "58 /routes/2/device is X400, which a FX3U does not have"},
        {R"("device": "D100")", R"("device": "D8512")", "43 /routes/0/device is D8512, which a FX3U does not have"},
        {R"("device": "D100")", R"("device": "M7680")", "43 /routes/0/device is M7680, which a FX3U does not have"},
        {R"("device": "D100")", R"("device": "D4294967396")",
         R"(43 /routes/0/device is "D4294967396", expected a device such as D100, M0 or X17 (octal))"},

        // Four registers, eight bits: the last place where they fit and the one behind it.
        {R"("device": "D100")", R"("device": "D7996")", ""},
        {R"("device": "D100")", R"("device": "D7997")",
         "43 /routes/0/device is D7997, but from there the count goes beyond D7999, the last one"},
        {R"("device": "D100")", R"("device": "D8508")", ""},
        {R"("device": "D100")", R"("device": "D8509")",
         "43 /routes/0/device is D8509, but from there the count goes beyond D8511, the last one"},
        {R"("device": "D100")", R"("device": "R32764")", ""},
        {R"("device": "D100")", R"("device": "R32765")",
         "43 /routes/0/device is R32765, but from there the count goes beyond R32767, the last one"},
        {R"("device": "D100")", R"("device": "CN254")", ""},  // 32 bits each
        {R"("device": "D100")", R"("device": "CN255")",
         "43 /routes/0/device is CN255, but from there the count goes beyond CN255, the last one"},
        {R"("device": "D100")", R"("device": "CN197")",
         "43 /routes/0/device is CN197, but from there the count goes beyond CN199, the last one"},
        {R"("device": "D100")", R"("device": "M7616")", ""},
        {R"("device": "D100")", R"("device": "M7617")",
         "43 /routes/0/device is M7617, but from there the count goes beyond M7679, the last one"},
        {R"("device": "X10")", R"("device": "X370")", ""},
        {R"("device": "X10")", R"("device": "X371")",
         "58 /routes/2/device is X371, but from there the count goes beyond X377, the last one"},
        {R"("device": "X10")", R"("device": "D7999")", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: each device has one source")
{
    const change_row rows[] = {
        {R"("device": "X10")", R"("device": "D100")",
         R"(58 /routes/2/device overlaps with the devices of route "pump.values": each device has one source)"},
        {R"("device": "X10")", R"("device": "D103")",
         R"(58 /routes/2/device overlaps with the devices of route "pump.values": each device has one source)"},
        {R"("device": "X10")", R"("device": "D104")", ""},
        {R"("device": "X10")", R"("device": "D99")", ""},  // eight bits of sixteen
        {R"("device": "X10")", R"("device": "R100")", ""},
        {R"("plc": "main",
      "device": "X10")",
         R"("plc": "spare", "device": "D100")", ""},
        // A write route only reads the PLC: what one station says can go to the next.
        {R"("device": "D10",)", R"("device": "D100",)", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: what one request can do")
{
    const auto route = [](const char* table, unsigned first, unsigned count, const char* way) {
        return R"({"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "d"}],
"stations": [{"name": "s", "line": "l", "unit": 1}],
"routes": [{"name": "r", "station": "s", "plc": "a", "device": "D0", "table": ")" +
               std::string(table) + "\", \"first\": " + std::to_string(first) + ",\n\"direction\": \"" + way +
               "\",\n\"count\": " + std::to_string(count) + "}]}";
    };
    const struct {
        const char* table;
        unsigned first;
        unsigned count;
        const char* way;
        const char* expected;
    } rows[] = {
        {"input", 0, 125, "read", ""},
        {"input", 0, 126, "read", "5 /routes/0/count is 126, but one MODBUS request carries 125: split the route"},
        {"holding", 0, 125, "read", ""},
        {"holding", 0, 126, "read", "5 /routes/0/count is 126, but one MODBUS request carries 125: split the route"},
        {"holding", 0, 123, "write", ""},
        {"holding", 0, 124, "write", "5 /routes/0/count is 124, but one MODBUS request carries 123: split the route"},
        {"coil", 0, 2000, "read", ""},
        {"discrete", 0, 2000, "read", ""},
        {"coil", 0, 1968, "write", ""},
        {"coil", 0, 1969, "write", "5 /routes/0/count is 1969, but one MODBUS request carries 1968: split the route"},
        {"input", 0, 1, "write", "3 /routes/0/table is read-only in MODBUS: a write route needs coil or holding"},
        {"discrete", 0, 1, "write", "3 /routes/0/table is read-only in MODBUS: a write route needs coil or holding"},
        {"input", 65535, 1, "read", ""},
        {"input", 65535, 2, "read", "5 /routes/0/count goes beyond address 65535"},
        {"coil", 63536, 2000, "read", ""},
        {"coil", 63537, 2000, "read", "5 /routes/0/count goes beyond address 65535"},
        {"input", 65411, 125, "read", ""},
        {"input", 65412, 125, "read", "5 /routes/0/count goes beyond address 65535"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.table) << " " << row.first << " " << row.count << " " << std::string(row.way));
        CHECK(said(route(row.table, row.first, row.count, row.way)) == row.expected);
    }
    check_row({R"("station": "pump")", R"("station": "everyone")",
               "38 /routes/0/station is unit 0, the broadcast: nobody answers, only write routes can use it"});
}

TEST_CASE("check: a PLC that speaks RTU only meets no ASCII, and serial units are those of a serial line")
{
    const struct {
        const char* rest;  // of a configuration with the FX3S "s", the FX3U "u" and an ASCII line
        const char* expected;
    } rows[] = {
        {R"("modbus_tcp": [{"framing": "ascii", "units": [{"unit": 1, "plc": "s"}]}])",
         "3 /modbus_tcp/0/units/0/plc is a FX3S, which speaks RTU only, on an ASCII line"},
        {R"("modbus_tcp": [{"framing": "ascii", "other_units": "s"}])",
         "3 /modbus_tcp/0/other_units is a FX3S, which speaks RTU only, on an ASCII line"},
        {R"("modbus_tcp": [{"framing": "ascii", "units": [{"unit": 247, "plc": "u"}]}])", ""},
        {R"("modbus_tcp": [{"framing": "rtu", "units": [{"unit": 1, "plc": "s"}], "other_units": "s"}])", ""},
        {R"("modbus_tcp": [{"units": [{"unit": 0, "plc": "s"}, {"unit": 255, "plc": "s"}]}])", ""},
        {R"("modbus_tcp": [{"framing": "rtu", "units": [{"unit": 0, "plc": "s"}]}])",
         "3 /modbus_tcp/0/units/0/unit is not within 1 to 247, the unit ids of a serial line"},
        {R"("modbus_tcp": [{"framing": "ascii", "units": [{"unit": 248, "plc": "u"}]}])",
         "3 /modbus_tcp/0/units/0/unit is not within 1 to 247, the unit ids of a serial line"},
        {R"("plcs": [{"name": "g", "model": "FX3G", "channels": [{"channel": 1, "line": "l"}]}])",
         "3 /plcs/0/channels/0/line is an ASCII line, but a FX3G speaks RTU only"},
        {R"("plcs": [{"name": "g", "channels": [{"channel": 1, "line": "l"}]}])", ""},
    };
    for (const auto& row : rows) {
        const std::string rest = row.rest;
        const std::string plcs =
            rest.starts_with("\"plcs\"") ? "" : R"("plcs": [{"name": "s", "model": "FX3S"}, {"name": "u"}],)";
        INFO(rest);
        CHECK(said("{" + plcs + R"("lines": [{"name": "l", "device": "d", "protocol": "modbus-ascii"}],)" + "\n\n" +
                   rest + "}") == row.expected);
    }
}

TEST_CASE("check: lines and PLC models")
{
    const change_row rows[] = {
        {R"("data_bits": 8)", R"("data_bits": 7)", "17 /lines/0/data_bits is 7, but MODBUS RTU needs 8 data bits"},
        {R"("model": "FX3U")", R"("model": "FX3UC")", ""},
        {R"("model": "FX3U")", R"("model": "fx3u")", ""},
        {R"("model": "FX3U")", R"("model": "FX5U")",
         R"(5 /plcs/0/model is "FX5U", expected one of: FX3S, FX3G, FX3GC, FX3U, FX3UC, LS22, LS32, FP7)"},
    };
    for (const change_row& row : rows)
        check_row(row);
}
