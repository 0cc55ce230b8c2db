// One mistake is told once: a default that stands in for what was meant causes no others.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

TEST_CASE("check: a value that cannot be read has no consequences")
{
    const change_row rows[] = {
        // The default unit id 1 is that of "pump".
        {R"("unit": 0 })", R"("unit": "0" })", R"(31 /stations/1/unit is "0", expected a whole number from 0 to 999)"},
        {R"("unit": 0 })", R"("retries": 0 })",
         "29 /stations/1 has no \"unit\": MODBUS unit id to 247, MEWTOCOL station to 99, MEWTOCOL7 to 999; 0 = all of "
         "them, for write routes only"},
        {R"("unit": 2, "plc": "spare")", R"("unit": 256, "plc": "spare")",
         "65 /modbus_tcp/0/units/1/unit is 256, expected a whole number from 0 to 255"},
        // The default direction is read, which a broadcast cannot.
        {R"("direction": "write")", R"("direction": "out")",
         R"(51 /routes/1/direction is "out", expected one of: read, write, write-through, read-write, periodic-write)"},
        {R"("direction": "write")", R"("drection": "write")",
         R"(51 /routes/1/drection is no known key: did you mean "direction"?)"},
        // The default table holds registers: at most 125, and sixteen bits for each.
        {R"("table": "discrete",
      "first": 0,
      "count": 8,)",
         R"("table": "bits", "first": 0, "count": 200,)",
         R"(54 /routes/2/table is "bits", expected one of: coil, discrete, input, holding)"},
        // The default port is that of nobody, the default address that of the first server.
        {R"("listen": "127.0.0.1",
      "port": 1503)",
         R"("listen": 127, "port": 1502)", "67 /modbus_tcp/1/listen is 127, expected a text in quotes"},
        {R"("other_units": "spare")", R"("other_units": 1)",
         "69 /modbus_tcp/1/other_units is 1, expected a text in quotes"},
        {R"("other_units": "spare")", R"("units": {})", "69 /modbus_tcp/1/units is no array: [ ... ]"},
        // Names that could not be read may be the ones that others use.
        {R"("name": "spare")", R"("name": 7)", "11 /plcs/1/name is 7, expected a text in quotes"},
        {R"("name": "south",)", R"("nam": "south",)",
         "21 /lines/1 has no \"name\": Name of the line\n21 /lines/1/nam is no known key: did you mean \"name\"?"},
        {R"("name": "pump",)", "", "25 /stations/0 has no \"name\": Name of the device"},
        {R"("LD M8411",)", "8411,", "7 /plcs/0/program/0 is 8411, expected a text in quotes"},
        {R"("model": "FX3U")", R"("model": 3)", "5 /plcs/0/model is 3, expected a text in quotes"},
        {R"("count": 20)", R"("count": 0)", "75 /dds/blocks/0/count is 0, expected a whole number from 1 to 1024"},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: a list that cannot be read has no consequences")
{
    CHECK(said(R"({"plcs": {"name": "a"}, "modbus_tcp": [{"other_units": "a"}]})") == "1 /plcs is no array: [ ... ]");
    CHECK(said("{\"lines\": 1,\n\"stations\": [{\"name\": \"s\", \"line\": \"l\", \"unit\": 1}]}") ==
          "1 /lines is no array: [ ... ]");
}

TEST_CASE("check: other mistakes of a row that is not read as a whole are still told")
{
    const change_row rows[] = {
        {R"("station": "meter",
      "table": "discrete")",
         R"("station": "metre", "table": "bits")",
         "53 /routes/2/table is \"bits\", expected one of: coil, discrete, input, holding\n"
         "53 /routes/2/station names the station \"metre\", which does not exist: did you mean \"meter\"?"},
        {R"("count": 8,
      "plc": "main",
      "device": "X10")",
         R"("count": "8", "plc": "mine", "device": "X1.8")",
         "56 /routes/2/count is \"8\", expected a whole number from 1 to 2000\n"
         "56 /routes/2/plc names the PLC \"mine\", which does not exist: did you mean \"main\"?\n"
         "56 /routes/2/device is \"X1.8\", expected a device such as D100, M0 or X17 (octal)"},
        {R"("count": 8,
      "plc": "main",
      "device": "X10")",
         R"("count": "8", "plc": "main", "device": "X8")",
         "56 /routes/2/count is \"8\", expected a whole number from 1 to 2000\n"
         "56 /routes/2/device is \"X8\", expected a device such as D100, M0 or X17 (octal)"},
        {R"("device": "/dev/ttyUSB1")", R"("device": "/dev/ttyUSB0", "baudrate": 1)",
         "22 /lines/1/baudrate is no known key: did you mean \"baud_rate\"?\n"
         "22 /lines/1/device is already the device of line \"north\": a port belongs to one line"},
    };
    for (const change_row& row : rows)
        check_row(row);
}
