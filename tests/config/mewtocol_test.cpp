// Mistakes with MEWTOCOL lines in the configuration.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// A server line whose units stand on line 2, and settings on line 3.
std::string served(const std::string& protocol, const std::string& units, const std::string& more = "",
                   const char* model = "FP7")
{
    return R"({"plcs": [{"name": "p", "model": ")" + std::string(model) + R"("}, {"name": "q", "model": "FP7"}],
"lines": [{"name": "l", "device": "d", "role": "server", "protocol": ")" +
           protocol + R"(", "units": [)" + units + "]" + more + "}]}";
}

std::string unit(unsigned number, const char* plc = "p", unsigned channel = 1)
{
    return R"({"unit": )" + std::to_string(number) + R"(, "plc": ")" + plc + R"(", "channel": )" +
           std::to_string(channel) + "}";
}

std::string dialect(const char* keys) { return ",\n\"mewtocol\": {\"dialect\": {" + std::string(keys) + "}}"; }

}  // namespace

TEST_CASE("check: stations of a MEWTOCOL line")
{
    const struct {
        const char* protocol;
        unsigned number;
        const char* expected;
    } rows[] = {
        {"mewtocol-com", 1, ""},
        {"mewtocol-com", 99, ""},
        {"mewtocol7-com", 999, ""},
        {"mewtocol-com", 0, "2 /lines/0/units/0/unit is not within 1 to 99, the stations of MEWTOCOL-COM"},
        {"mewtocol-com", 100, "2 /lines/0/units/0/unit is not within 1 to 99, the stations of MEWTOCOL-COM"},
        {"mewtocol7-com", 0, "2 /lines/0/units/0/unit is not within 1 to 999, the stations of MEWTOCOL7-COM"},
        {"modbus-rtu", 248, "2 /lines/0/units/0/unit is not within 1 to 247, the unit ids of a serial line"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.protocol) << " " << row.number);
        CHECK(said(served(row.protocol, unit(row.number))) == row.expected);
    }
}

TEST_CASE("check: MEWTOCOL is spoken by an FP7")
{
    for (const char* const model : {"FX3U", "FX3G", "LS32"})
        CHECK(said(served("mewtocol-com", unit(1), "", model)) ==
              "2 /lines/0/units/0/plc is a " + std::string(model) + ", which does not speak MEWTOCOL: an FP7 does");
}

TEST_CASE("check: a COM port of an FP7 stands for one station")
{
    CHECK(said(served("mewtocol-com", unit(1) + ", " + unit(2, "q"))) == "");
    CHECK(said(served("mewtocol-com", unit(1) + ", " + unit(2, "p", 2))) == "");
    CHECK(said(served("mewtocol-com", unit(1) + ", " + unit(2))) ==
          "2 /lines/0/units/1/channel is COM.1 of \"p\", which /lines/0/units/0/channel gives to line \"l\" already: a "
          "port has one line and one station, give another one");
    CHECK(said(served("modbus-rtu", unit(1) + ", " + unit(2), "", "FX3U")) == "");
}

TEST_CASE("check: the dialect of MEWTOCOL7-COM")
{
    const struct {
        const char* keys;
        const char* expected;
    } rows[] = {
        {R"("item": "", "scope": "", "base": "hexadecimal", "words": "high-byte-first")", ""},
        {R"("dt": "D", "ld": "L")", ""},
        {R"("address_digits": 9)",
         "3 /lines/0/mewtocol/dialect/address_digits is 9, expected a whole number from 1 to 8"},
        {R"("scope": "g0")", "3 /lines/0/mewtocol/dialect/scope is \"g0\", expected capital letters and digits"},
        {R"("before_words": "&")",
         "3 /lines/0/mewtocol/dialect/before_words is \"&\", expected capital letters and digits"},
        {R"("dt": "L", "ld": "LD")",
         "3 /lines/0/mewtocol/dialect/ld is \"LD\", which begins like \"L\", the name of another area"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.keys));
        CHECK(said(served("mewtocol7-com", unit(1), dialect(row.keys))) == row.expected);
    }
}

TEST_SUITE_END();
