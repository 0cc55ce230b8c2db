// A channel of a PLC that two lines want.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// Lines "a" and "b" are servers, "c" and "d" clients.
std::string wired(const std::string& model, const std::string& channels, const std::string& a_units,
                  const std::string& b_units)
{
    const auto line = [](const char* name, const std::string& more) {
        return std::string("{\"name\": \"") + name + "\", \"device\": \"/dev/" + name + "\"" + more + "}";
    };
    const auto server = [](const std::string& units) { return R"(, "role": "server", "units": [)" + units + "]"; };
    return R"({"plcs": [{"name": "p", "model": ")" + model + R"(", "channels": [)" + channels +
           "]}, {\"name\": \"q\", \"model\": \"" + model + "\"}],\n\"lines\": [" + line("a", server(a_units)) + ",\n" +
           line("b", server(b_units)) + ",\n" + line("c", "") + ",\n" + line("d", "") + "]}";
}

std::string asks(unsigned channel, const char* line)
{
    return R"({"channel": )" + std::to_string(channel) + R"(, "line": ")" + line + "\"}";
}

const std::string p = R"({"unit": 1, "plc": "p"})";
const std::string p_at_2 = R"({"unit": 2, "plc": "p", "channel": 2})";
const std::string q = R"({"unit": 1, "plc": "q"})";

}  // namespace

TEST_CASE("check: a channel of a PLC has one line")
{
    const struct {
        const char* what;
        std::string text;
        std::string expected;
    } rows[] = {
        {"each its own", wired("FX3U", asks(2, "c"), p, q), ""},
        {"two channels, two lines", wired("FX3U", "", p, p_at_2), ""},
        {"two units of one line are one port", wired("FX3U", "", p + R"(, {"unit": 3, "plc": "p"})", q), ""},
        {"two server lines", wired("FX3U", "", p, p),
         "3 /lines/1/units/0/channel is channel 1 of \"p\", which /lines/0/units/0/channel gives to line \"a\" "
         "already: "
         "a channel has one line, give another one"},
        {"two COM ports of an FP7", wired("FP7", "", p, p_at_2), ""},
        {"a COM port of an FP7", wired("FP7", "", p_at_2, p_at_2),
         "3 /lines/1/units/0/channel is COM.2 of \"p\", which /lines/0/units/0/channel gives to line \"a\" already: a "
         "port has one line and one station, give another one"},
        {"asks on two lines", wired("FX3U", asks(1, "c") + ", " + asks(1, "d"), q, p_at_2),
         "1 /plcs/0/channels/1/channel is channel 1 of \"p\", which /plcs/0/channels/0/channel gives to line \"c\" "
         "already: a channel has one line, give another one"},
        {"asks twice on one line", wired("FX3U", asks(1, "c") + ", " + asks(1, "c"), q, p_at_2),
         "1 /plcs/0/channels/1/channel is channel 1 of \"p\", which /plcs/0/channels/0/channel gives to line \"c\" "
         "already: a channel has one line, give another one"},
        {"asks on one, is asked on another", wired("FX3U", asks(2, "c"), q, p_at_2),
         "3 /lines/1/units/0/channel is channel 2 of \"p\", which /plcs/0/channels/0/channel gives to line \"c\" "
         "already: a channel has one line, give another one"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.what));
        CHECK(said(row.text) == row.expected);
    }
}

TEST_CASE("check: a COM port of an FP7 is a line of its own")
{
    // A line of each kind that is no server, and "s", which is one and stands for COM.2 of "q".
    const auto ports = [](const std::string& of_p) {
        return R"({"plcs": [{"name": "p", "model": "FP7", "channels": [)" + of_p + R"(]},
{"name": "q", "model": "FP7", "channels": [{"channel": 1, "line": "taken"}]}, {"name": "main"}],
"lines": [{"name": "text", "device": "/dev/a", "protocol": "general-purpose",
  "general_purpose": {"received": [{"name": "r", "plc": "p", "device": "DT0", "count": 9, "ready": "R0"}]}},
{"name": "rtu", "device": "/dev/b"}, {"name": "com", "device": "/dev/c", "protocol": "mewtocol-com"},
{"name": "com7", "device": "/dev/d", "protocol": "mewtocol7-com"},
{"name": "ascii", "device": "/dev/e", "protocol": "modbus-ascii"},
{"name": "tcp", "host": "h", "protocol": "modbus-tcp"},
{"name": "taken", "device": "/dev/f"},
{"name": "s", "device": "/dev/g", "protocol": "mewtocol-com", "role": "server",
 "units": [{"unit": 1, "plc": "p", "channel": 2}]}]})";
    };
    const struct {
        std::string ports;
        std::string expected;
    } rows[] = {
        {"", ""},
        {asks(0, "text"), ""},
        {asks(0, "rtu") + ", " + asks(1, "com"), ""},
        {asks(3, "text"), "1 /plcs/0/channels/0/channel is a port that a FP7 does not have"},
        {asks(2, "text"),
         "11 /lines/7/units/0/channel is COM.2 of \"p\", which /plcs/0/channels/0/channel gives to line \"text\" "
         "already: a port has one line and one station, give another one"},
        {asks(0, "text") + ", " + asks(0, "rtu"),
         "1 /plcs/0/channels/1/channel is COM.0 of \"p\", which /plcs/0/channels/0/channel gives to line \"text\" "
         "already: a port has one line and one station, give another one"},
        {asks(0, "text") + ", " + asks(1, "text"), "1 /plcs/0/channels/1/line is \"text\", which stands for the port "
                                                   "of /plcs/0/channels/0 already: a line is one "
                                                   "port"},
        {asks(0, "taken"),
         "2 /plcs/1/channels/0/line is \"taken\", which stands for the port of /plcs/0/channels/0 already: a line is "
         "one port"},
        {asks(0, "s"), "1 /plcs/0/channels/0/line is a server line: give it a unit with this \"channel\" instead"},
    };
    for (const auto& row : rows) {
        INFO(row.ports);
        CHECK(said(ports(row.ports)) == row.expected);
    }
    for (const char* other : {"com7", "ascii", "tcp"})
        CHECK(said(ports(asks(0, other))) ==
              "1 /plcs/0/channels/0/line speaks what no COM port of a FP7 asks with: it is general-purpose, modbus-rtu "
              "or mewtocol-com");
    CHECK(said(changed("\"R0\"", "\"X0\"", ports(""))) ==
          "4 /lines/0/general_purpose/received/0/ready reaches into X0-X1F, where a FP7 shows its own communication: "
          "choose other devices");
}

TEST_CASE("check: channels of other PLCs begin at 1")
{
    CHECK(said(wired("FX3U", asks(0, "c"), p, q)) ==
          "1 /plcs/0/channels/0/channel is 0, where a FX3U cannot be client");
}

TEST_SUITE_END();
