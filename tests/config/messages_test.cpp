// General-purpose lines: what no single value shows.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

constexpr std::string_view weighbridge = R"({ "plcs": [
  { "name": "main" } ],
"lines": [
  { "name": "modbus", "device": "/dev/ttyUSB0" },
  { "name": "scale", "device": "/dev/ttyUSB1", "protocol": "general-purpose",
    "general_purpose": {
      "received": [
        { "name": "raw", "plc": "main", "device": "D100", "count": 20,
          "ready": "M0", "when_full": "stop" } ],
      "messages": [
        { "name": "weighing",
          "pattern": "{state:text(2)},{weight:number}kg",
          "plc": "main",
          "answer_to": "ask",
          "fields": [
            { "name": "weight", "device": "D200", "type": "int32" },
            { "name": "state", "device": "D202", "type": "text", "characters": 2 } ] } ],
      "sends": [
        { "name": "ask", "text": "W", "period_ms": 500, "answer": true },
        { "name": "tell", "plc": "main", "trigger": "M1", "device": "D300", "count": 10 } ],
      "status": { "plc": "main", "device": "D400", "reset": "M2" } } } ],
"stations": [
  { "name": "pump", "line": "modbus", "unit": 1 } ],
"routes": [
  { "name": "pump.values", "station": "pump", "table": "input", "first": 0, "plc": "main", "device": "D500" } ]
})";

void check(std::string_view from, std::string_view to, std::string_view expected)
{
    INFO(std::string(to));
    CHECK(said(changed(from, to, weighbridge)) == expected);
}

}  // namespace

TEST_CASE("check: a general-purpose line")
{
    CHECK(said(weighbridge) == "");
    const change_row rows[] = {
        {R"("protocol": "general-purpose")", R"("protocol": "modbus-rtu")",
         "6 /lines/1/general_purpose stands at a line whose \"protocol\" is not general-purpose"},
        {R"("protocol": "general-purpose",)", R"("protocol": "general-purpose", "role": "server",)",
         "5 /lines/1/role is server, which a general-purpose line cannot be"},
        {R"("line": "modbus")", R"("line": "scale")",
         "23 /stations/0/line is a general-purpose line: nobody can be asked there"},
        {R"({ "name": "main" })", R"({ "name": "main", "channels": [{ "channel": 1, "line": "scale" }] })",
         "2 /plcs/0/channels/0/line is a general-purpose line: ADPRW cannot ask there"},
        {R"({ "name": "modbus", "device": "/dev/ttyUSB0" })",
         R"({ "name": "modbus", "device": "/dev/ttyUSB0", "protocol": "general-purpose" })",
         "4 /lines/0 does nothing: give \"general_purpose\" with received, messages, sends or dds_sends\n"
         "23 /stations/0/line is a general-purpose line: nobody can be asked there"},
        {R"({ "name": "modbus", "device": "/dev/ttyUSB0" })",
         R"({ "name": "modbus", "device": "/dev/ttyUSB0", "general_purpose": { "dds_sends": true } })",
         "4 /lines/0/general_purpose stands at a line whose \"protocol\" is not general-purpose\n"
         "4 warning /lines/0/general_purpose/dds_sends is true, but allows nothing while /dds/writes is false"},
    };
    for (const change_row& row : rows)
        check(row.from, row.to, row.expected);
    CHECK(said(R"({ "lines": [{ "name": "display", "device": "/dev/ttyS0", "protocol": "general-purpose",
                               "general_purpose": { "dds_sends": true } }], "dds": { "writes": true } })") == "");
}

TEST_CASE("check: patterns and fields")
{
    const change_row rows[] = {
        {R"({weight:number}kg)", R"({weight:numbr}kg)",
         "12 /lines/1/general_purpose/messages/0/pattern is wrong at character 25: \"numbr\" is no form: "
         "expected number, number(,), scientific, hex(4), text, text(5), spaces, or a picture as +###.#"},
        {R"("name": "weight", "device")", R"("name": "wait", "device")",
         "16 /lines/1/general_purpose/messages/0/fields/0 does not fit its pattern: the pattern has no field of the "
         "name wait"},
        {R"("type": "text", "characters": 2)", R"("type": "uint16")",
         "17 /lines/1/general_purpose/messages/0/fields/1 does not fit its pattern: field state is text in the "
         "pattern, its type must be text"},
        {R"("type": "text", "characters": 2)", R"("type": "text")",
         "17 /lines/1/general_purpose/messages/0/fields/1 does not fit its pattern: field state: text needs room for "
         "1 to 4096 characters"},
        {R"("type": "int32")", R"("type": "int32", "characters": 2)",
         "16 /lines/1/general_purpose/messages/0/fields/0/characters stands at a number: only text has a size"},
        {R"("answer_to": "ask")", R"("answer_to": "asks")",
         "14 /lines/1/general_purpose/messages/0/answer_to names the send \"asks\", which this line does not have"},
        {R"("answer_to": "ask")", R"("answer_to": "tell")",
         "14 /lines/1/general_purpose/messages/0/answer_to names the send \"tell\", which expects no \"answer\""},
    };
    for (const change_row& row : rows)
        check(row.from, row.to, row.expected);
}

TEST_CASE("check: devices of messages")
{
    const change_row rows[] = {
        {R"("device": "D200")", R"("device": "Z200")",
         R"(16 /lines/1/general_purpose/messages/0/fields/0/device is "Z200", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "D200")", R"("device": "D7999")",
         "16 /lines/1/general_purpose/messages/0/fields/0/device is D7999, but from there the count goes beyond D7999, "
         "the last one"},
        {R"("device": "D200")", R"("device": "D201")",
         "17 /lines/1/general_purpose/messages/0/fields/1/device overlaps with the devices of field "
         "\"weighing.weight\": each device has one source"},
        {R"("device": "D200")", R"("device": "D119")",
         "16 /lines/1/general_purpose/messages/0/fields/0/device overlaps with the devices of received \"raw\": each "
         "device has one source"},
        {R"("device": "D200")", R"("device": "D500")",
         "16 /lines/1/general_purpose/messages/0/fields/0/device overlaps with the devices of route \"pump.values\": "
         "each device has one source"},
        {R"("device": "D400")", R"("device": "D112")",
         "21 /lines/1/general_purpose/status/device overlaps with the devices of received \"raw\": each device has one "
         "source"},
        {R"("ready": "M0")", R"("ready": "D0")",
         "9 /lines/1/general_purpose/received/0/ready is D0, expected a bit such as M0"},
        {R"("ready": "M0", )", "",
         "9 warning /lines/1/general_purpose/received/0/when_full is stop, but without \"ready\" the buffers never "
         "fill: give the bit"},
        {R"("plc": "main",
          "answer_to")",
         R"("plc": "mian",
          "answer_to")",
         R"(13 /lines/1/general_purpose/messages/0/plc names the PLC "mian", which does not exist: did you mean "main"?)"},
    };
    for (const change_row& row : rows)
        check(row.from, row.to, row.expected);
}

TEST_CASE("check: what is sent")
{
    const change_row rows[] = {
        {R"("text": "W", "period_ms": 500)", R"("text": "W")",
         "19 /lines/1/general_purpose/sends/0 is never sent: give \"period_ms\" or \"trigger\""},
        {R"("text": "W", "period_ms": 500)", R"("text": "W", "period_ms": 9)",
         "19 /lines/1/general_purpose/sends/0/period_ms is 9, expected 10 or more, or 0"},
        {R"("text": "W")", R"("text": "W\\xZZ")",
         "19 /lines/1/general_purpose/sends/0/text is wrong at character 2: \\x needs two hexadecimal digits, as "
         "\\x05"},
        {R"("text": "W", )", "",
         "19 /lines/1/general_purpose/sends/0 sends nothing: give \"text\", or \"device\" and \"count\""},
        {R"("plc": "main", "trigger": "M1")", R"("plc": "main", "text": "X", "trigger": "M1")",
         "20 /lines/1/general_purpose/sends/1 sends two things: give \"text\" or \"device\""},
        {R"("plc": "main", "trigger": "M1")", R"("trigger": "M1")",
         "20 /lines/1/general_purpose/sends/1 lacks \"plc\": whose devices are these?"},
        {R"("device": "D300", "count": 10)", R"("device": "D300", "count": 1)",
         "20 /lines/1/general_purpose/sends/1/count is 1, expected 2 or more: the word of the count and those of the "
         "bytes"},
    };
    for (const change_row& row : rows)
        check(row.from, row.to, row.expected);
    check(R"("name": "tell")", R"("name": "ask")",
          "20 /lines/1/general_purpose/sends/1/name \"ask\" stands twice: give each its own name");
}

TEST_CASE("check: what comes from routes, messages and blocks has names of its own in DDS")
{
    check(R"("name": "pump.values")", R"("name": "weighing.weight")",
          "16 /lines/1/general_purpose/messages/0/fields/0/name makes \"weighing.weight\", the name of a route in DDS: "
          "rename one of them");
    check(R"("name": "pump.values")", R"("name": "raw")",
          "8 /lines/1/general_purpose/received/0/name makes \"raw\", the name of a route in DDS: rename one of them");
    const std::string with_block =
        changed(R"("device": "D500" } ])",
                R"("device": "D500" } ], "dds": { "blocks": [{ "plc": "main", "device": "D0" }] })", weighbridge);
    CHECK(said(changed(R"("name": "pump.values")", R"("name": "main.D0")", with_block)) ==
          "25 /dds/blocks/0/device makes \"main.D0\", the name of a route in DDS: rename one of them");
}
