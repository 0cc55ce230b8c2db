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

TEST_SUITE_END();
