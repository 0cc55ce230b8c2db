// One value that is wrong: one mistake, with its place, what it is and what is expected.
#include "daemon/config/reader.hpp"
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("reader");

using namespace plcgw::config;
using plcgw::gateway_config;

TEST_CASE("reader: the plant is correct")
{
    CHECK(said(plant) == "");
    CHECK(said("{}") == "");
}

TEST_CASE("reader: wrong values of each type")
{
    const change_row rows[] = {
        // text
        {R"("gateway": "plant")", R"("gateway": 7)", "2 /gateway is 7, expected a text in quotes"},
        {R"("gateway": "plant")", R"("gateway": null)", "2 /gateway is null, expected a text in quotes"},
        {R"("gateway": "plant")", R"("gateway": true)", "2 /gateway is true, expected a text in quotes"},
        {R"("gateway": "plant")", R"("gateway": ["a"])", R"(2 /gateway is ["a"], expected a text in quotes)"},
        {R"("gateway": "plant")", R"("gateway": {"a": 1})", R"(2 /gateway is {"a":1}, expected a text in quotes)"},
        {R"("gateway": "plant")", R"("gateway": "")", "2 /gateway is empty: give it a text"},
        {R"("gateway": "plant")", R"("gateway": "a\nb")",
         R"(2 /gateway is "a\nb", expected a text without line breaks and control characters)"},
        {R"("gateway": "plant")", R"("gateway": "a\u0000b")",
         R"(2 /gateway is "a\u0000b", expected a text without line breaks and control characters)"},
        {R"("gateway": "plant")", R"("gateway": "a\u007f")",
         "2 /gateway is \"a\x7F\", expected a text without line breaks and control characters"},
        {R"("device": "D100")", R"("device": "D")", R"(43 /routes/0/device is "D", which is too short)"},
        {R"("device": "D100")", R"("device": "D0000000000000100")",
         "43 /routes/0/device is longer than 16 bytes: shorten it"},

        // true or false
        {R"("enabled": true)", R"("enabled": 1)", "19 /lines/0/rs485/enabled is 1, expected true or false"},
        {R"("enabled": true)", R"("enabled": "yes")", R"(19 /lines/0/rs485/enabled is "yes", expected true or false)"},
        {R"("enabled": true)", R"("enabled": null)", "19 /lines/0/rs485/enabled is null, expected true or false"},

        // number
        {R"("baud_rate": 9600)", R"("baud_rate": "9600")",
         R"(16 /lines/0/baud_rate is "9600", expected a whole number from 300 to 4000000)"},
        {R"("baud_rate": 9600)", R"("baud_rate": 299)",
         "16 /lines/0/baud_rate is 299, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": 4000001)",
         "16 /lines/0/baud_rate is 4000001, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": -9600)",
         "16 /lines/0/baud_rate is -9600, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": 9600.5)",
         "16 /lines/0/baud_rate is 9600.5, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": 1e300)",
         "16 /lines/0/baud_rate is 1e+300, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": 18446744073709551615)",
         "16 /lines/0/baud_rate is 18446744073709551615, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": 4294976896)",  // 9600 in the lower 32 bits
         "16 /lines/0/baud_rate is 4294976896, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": -9223372036854775809)",
         "16 /lines/0/baud_rate is -9.223372036854776e+18, expected a whole number from 300 to 4000000"},
        {R"("baud_rate": 9600)", R"("baud_rate": false)",
         "16 /lines/0/baud_rate is false, expected a whole number from 300 to 4000000"},
        {R"("retries": 0)", R"("retries": [0])", "28 /stations/0/retries is [0], expected a whole number from 0 to 20"},
        {R"("retries": 0)", R"("retries": null)",
         "28 /stations/0/retries is null, expected a whole number from 0 to 20"},

        // duration
        {R"("period_ms": 200)", R"("period_ms": "200 ms")",
         R"(44 /routes/0/period_ms is "200 ms", expected a whole number from 10 to 86400000)"},
        {R"("period_ms": 200)", R"("period_ms": 9)",
         "44 /routes/0/period_ms is 9, expected a whole number from 10 to 86400000"},

        // one of a few words
        {R"("parity": "none")", R"("parity": "mark")",
         R"(18 /lines/0/parity is "mark", expected one of: none, odd, even)"},
        {R"("parity": "none")", R"("parity": "None")",
         R"(18 /lines/0/parity is "None", expected one of: none, odd, even)"},
        {R"("parity": "none")", R"("parity": "")", R"(18 /lines/0/parity is "", expected one of: none, odd, even)"},
        {R"("parity": "none")", R"("parity": 0)", "18 /lines/0/parity is 0, expected one of: none, odd, even"},
        {R"("parity": "none")", R"("parity": "none", "protocol": "profibus")",
         R"(18 /lines/0/protocol is "profibus", expected one of: modbus-rtu, modbus-ascii, modbus-tcp, mewtocol-com, mewtocol7-com, general-purpose)"},
        {R"("table": "discrete")", R"("table": "coils")",
         R"(54 /routes/2/table is "coils", expected one of: coil, discrete, input, holding)"},
        {R"("level": "debug")", R"("level": "verbose")",
         R"(79 /log/level is "verbose", expected one of: debug, info, warning, error)"},

        // array of texts
        {R"([ "192.168.1.5" ])", R"("192.168.1.5")",
         R"(73 /dds/peers is "192.168.1.5", expected an array of texts: [ "...", "..." ])"},
        {R"([ "192.168.1.5" ])", R"({})", R"(73 /dds/peers is {}, expected an array of texts: [ "...", "..." ])"},
        {R"([ "192.168.1.5" ])", "[ \"192.168.1.5\",\n 7,\n \"\" ]",
         "74 /dds/peers/1 is 7, expected a text in quotes\n75 /dds/peers/2 is empty: give it a text"},

        // array of objects, object
        {R"("units": [
        { "unit": 1, "plc": "main" },
        { "unit": 2, "plc": "spare" }
      ])",
         R"("units": { "unit": 1, "plc": "main" })", "63 /modbus_tcp/0/units is no array: [ ... ]"},
        {R"({ "unit": 2, "plc": "spare" })", "2", "65 /modbus_tcp/0/units/1 is no object: { ... }"},
        {R"("log": { "level": "debug" })", R"("log": "debug")", "79 /log is no object: { ... }"},
        {R"("log": { "level": "debug" })", R"("log": null)", "79 /log is no object: { ... }"},
        {R"({ "enabled": true })", "[]", "19 /lines/0/rs485 is no object: { ... }"},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("reader: a long wrong value is shown in part, whole characters only")
{
    const std::string umlauts = "\"" + std::string(59, 'a') + "ä" + std::string(10, 'b') + "\"";
    CHECK(said("{\"log\": {\"level\": " + umlauts + "}}") ==
          "1 /log/level is \"" + std::string(59, 'a') + "..., expected one of: debug, info, warning, error");
    CHECK(said("{\"dds\": {\"domain\": " + umlauts + "}}") ==
          "1 /dds/domain is \"" + std::string(59, 'a') + "..., expected a whole number from 0 to 230");
}

TEST_CASE("reader: right values at the ends of their ranges, and 1.0, an integer to JSON Schema")
{
    const change_row rows[] = {
        {R"("baud_rate": 9600)", R"("baud_rate": 300)", ""},
        {R"("baud_rate": 9600)", R"("baud_rate": 4000000)", ""},
        {R"("baud_rate": 9600)", R"("baud_rate": 9.6e3)", ""},
        {R"("retries": 0)", R"("retries": -0.0)", ""},
        {R"("domain": 7)", R"("domain": 230)", ""},
        {R"("gateway": "plant")", R"("gateway": "Werk Süd\t1")", ""},
        {R"("device": "D100")", R"("device": "d100")", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
    CHECK(load_text(changed(R"("baud_rate": 9600)", R"("baud_rate": 9.6e3)"), {}).config.lines[0].baud_rate == 9600);
    const std::string name(64, 'a');
    CHECK(load_text("{\"gateway\": \"" + name + "\"}", {}).config.gateway == name);
    CHECK(said("{\"gateway\": \"" + name + "a\"}") == "1 /gateway is longer than 64 bytes: shorten it");
    // Bytes count, since DDS strings have bounds: 33 characters of two bytes.
    std::string umlauts;
    for (int i = 0; i < 33; ++i)
        umlauts += "ü";
    CHECK(said("{\"gateway\": \"" + umlauts + "\"}") == "1 /gateway is longer than 64 bytes: shorten it");
}

TEST_CASE("reader: unknown keys")
{
    const change_row rows[] = {
        {R"("baud_rate")", R"("baudrate")", R"(16 /lines/0/baudrate is no known key: did you mean "baud_rate"?)"},
        {R"("period_ms")", R"("period")", R"(44 /routes/0/period is no known key: did you mean "period_ms"?)"},
        {R"("gateway")", R"("Gateway")", R"(2 /Gateway is no known key: did you mean "gateway"?)"},
        {R"("log")", R"("logs")", R"(79 /logs is no known key: did you mean "log"?)"},
        {R"("enabled")", R"("enable")", R"(19 /lines/0/rs485/enable is no known key: did you mean "enabled"?)"},
        {R"("domain")", R"("domain_id")", R"(72 /dds/domain_id is no known key: did you mean "domain"?)"},
        {R"("level": "debug")", R"("file/name~": "debug")", R"(79 /log/file~1name~0 is no known key: known are level)"},
        {R"("level": "debug")", R"("": "debug")", "79 /log/ is no known key: known are level"},
        {R"("enabled")", R"("auto")",
         "19 /lines/0/rs485/auto is no known key: known are enabled, rts_on_send, rts_after_send, rx_during_tx, "
         "delay_before_send_ms, delay_after_send_ms"},
        {R"("log": {)", R"("zzz": 0, "log": {)",
         "79 /zzz is no known key: known are $schema, gateway, plcs, lines, stations, routes, points, modbus_tcp, "
         "plc_links, dds, standby, log, control, state"},
        // The value of an unknown key is not looked into.
        {R"("level": "debug")", R"("level": "debug", "colour": { "baudrate": [ {} ] })",
         "79 /log/colour is no known key: known are level"},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("reader: required keys that are missing, with the line of their row")
{
    const change_row rows[] = {
        {R"({ "name": "spare" })", "{}", "11 /plcs/1 has no \"name\": Name of the simulated PLC"},
        {R"("device": "/dev/ttyUSB1")", R"("retries": 1)",
         "21 /lines/1 lacks \"device\": the path of a serial port, or \"host\": a device server's address"},
        {R"({ "unit": 2, "plc": "spare" })", R"({ "plc": "spare" })",
         "65 /modbus_tcp/0/units/1 has no \"unit\": MODBUS unit id"},
        {R"({ "plc": "main", "device": "M0" })", "{}",
         "76 /dds/blocks/1 has no \"plc\": Name of the simulated PLC\n76 /dds/blocks/1 has no \"device\": First "
         "device"},
    };
    for (const change_row& row : rows)
        check_row(row);
    CHECK(said("{\"stations\": [\n{}],\n\"routes\": [\n{}]}") ==
          "2 /stations/0 has no \"name\": Name of the device\n"
          "2 /stations/0 has no \"line\": Name of its line\n"
          "2 /stations/0 has no \"unit\": MODBUS unit id to 247, MEWTOCOL station to 99, MEWTOCOL7 to 999; 0 = all of "
          "them, for write routes only\n"
          "4 /routes/0 has no \"name\": Name of the route: key of its DDS instance\n"
          "4 /routes/0 has no \"plc\": Name of the simulated PLC\n"
          "4 /routes/0 has no \"device\": First device in its memory, for example D100, M0, X17 (octal); DT100, R1F, "
          "WR3 in an FP7");
}

TEST_CASE("reader: all mistakes of a file at once, in the order of its lines")
{
    std::string text(plant);
    const struct {
        const char* from;
        const char* to;
    } changes[] = {
        {R"("gateway": "plant")", R"("gateway": 5)"},
        {R"("MOV K0 D8471")", R"("MUV K0 D8471")"},
        {R"("baud_rate": 9600)", R"("baudrate": 9600)"},
        {R"("data_bits": 8)", R"("data_bits": 7)"},
        {R"("parity": "none")", R"("parity": "mark")"},
        {R"("device": "/dev/ttyUSB1")", R"("device": "/dev/ttyUSB0")"},
        {R"("line": "south")", R"("line": "sooth")"},
        {R"("table": "input")", R"("table": "inputs")"},
        {R"("device": "D10",)", R"("device": "D9000",)"},
        {R"("device": "X10")", R"("device": "X8")"},
        {R"("port": 1503)", R"("port": 1502)"},
        {R"([ "192.168.1.5" ])", R"([ "backup" ])"},
    };
    for (const auto& each : changes)
        text = changed(each.from, each.to, text);
    CHECK(load_text(text, {}).found.size() == 12);
    CHECK(said(text) ==
          "2 /gateway is 5, expected a text in quotes\n"
          "9 /plcs/0/program/2 unknown instruction \"MUV\": a program holds LD, MOV, ADPRW and END\n"
          "16 /lines/0/baudrate is no known key: did you mean \"baud_rate\"?\n"
          "17 /lines/0/data_bits is 7, but MODBUS RTU needs 8 data bits\n"
          "18 /lines/0/parity is \"mark\", expected one of: none, odd, even\n"
          "22 /lines/1/device is already the device of line \"north\": a port belongs to one line\n"
          "33 /stations/2/line names the line \"sooth\", which does not exist: did you mean \"south\"?\n"
          "39 /routes/0/table is \"inputs\", expected one of: coil, discrete, input, holding\n"
          "50 /routes/1/device is D9000, which a FX3U does not have\n"
          "58 /routes/2/device is \"X8\", expected a device such as D100, M0 or X17 (octal)\n"
          "68 /modbus_tcp/1/port is 1502, which /modbus_tcp/0 takes already: listen on another port or address\n"
          "73 /dds/peers/0 is \"backup\", expected an IPv4 address such as 192.168.1.5, not a name");
}

TEST_CASE("reader: what is right is read although other things are wrong")
{
    const auto c = load_text(changed(R"("parity": "none")", R"("parity": "mark")"), {}).config;
    CHECK(c.gateway == "plant");
    REQUIRE(c.lines.size() == 2);
    CHECK(c.lines[0].baud_rate == 9600);
    CHECK(c.lines[0].check == plcgw::line_config{}.check);
    CHECK(c.lines[0].rs485.enabled);
    CHECK(c.log.level == plcgw::log_level::debug);
}

TEST_CASE("reader: the nearest known word")
{
    const std::vector<std::string> known = {"name", "line", "unit", "response_timeout_ms", "retries"};
    const struct {
        std::string word;
        std::string nearest;
    } rows[] = {
        {"nmae", "name"},
        {"nam", "name"},
        {"NAME", "name"},
        {"retries_", "retries"},
        {"retry", ""},
        {"response", "response_timeout_ms"},
        {"timeout", ""},
        {"response_timeout", "response_timeout_ms"},
        {"response-time-out-ms", "response_timeout_ms"},
        {"port", ""},
        {"", ""},
    };
    for (const auto& row : rows) {
        INFO(row.word);
        CHECK(nearest(row.word, known) == row.nearest);
    }
    CHECK(nearest("anything", {}).empty());
}
