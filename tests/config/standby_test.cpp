// Mistakes in what makes a gateway a member of a pair.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

TEST_CASE("check: a member of a pair")
{
    const struct {
        const char* standby;
        const char* dds;
        const char* expected;
    } rows[] = {
        {R"({"priority": 100})", R"({"member": "a"})", ""},
        {R"({"priority": 100})", R"({"interface": "eth0"})", ""},
        {R"({"priority": 0, "hand_back": false, "lease_ms": 100, "line_silence_ms": 200, "listen_ms": 500})",
         R"({"member": "a"})", ""},
        {R"({})", R"({"member": "a"})",
         R"(2 /standby has no "priority": Of two members that could both be active the higher one is; equal: the name)"},
        {R"({"priority": 101})", R"({"member": "a"})",
         "2 /standby/priority is 101, expected a whole number from 0 to 100"},
        {R"({"priority": 1})", R"({"member": "a", "enabled": false})",
         R"(2 /standby needs DDS, by which two members know of each other: set "enabled" of "dds" to true)"},
        {R"({"priority": 1})", R"({})",
         "2 /standby has both members on this host, and both would be called by the host's name: give each its own "
         R"("member" in "dds")"},
        {R"({"priority": 1, "line_silence_ms": 900})", R"({"member": "a"})",
         "2 /standby/line_silence_ms is 900, expected at least twice the lease_ms of 500"},
        {R"({"priority": 1, "lease_ms": 1500, "line_silence_ms": 3000})", R"({"member": "a"})",
         "2 /standby/listen_ms is 2000, expected at least twice the lease_ms of 1500"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.standby);
        CAPTURE(row.dds);
        CHECK(said(std::string("{\n\"standby\": ") + row.standby + ",\n\"dds\": " + row.dds + "}") == row.expected);
    }
}

TEST_CASE("check: a serial line that is read too seldom for its pair")
{
    const auto plant = [](const char* line, const char* period) {
        return std::string(R"({"plcs": [{"name": "p"}], "standby": {"priority": 1}, "dds": {"member": "a"},
"lines": [)") + line +
               R"(], "stations": [{"name": "s", "line": "l", "unit": 1}],
"routes": [{"name": "r", "station": "s", "table": "holding", "first": 0, "plc": "p", "device": "D0", "period_ms": )" +
               period + "}]}";
    };
    CHECK(said(plant(R"({"name": "l", "device": "/dev/null"})", "2000")).empty());
    CHECK(said(plant(R"({"name": "l", "host": "10.0.0.1"})", "5000")).empty());
    CHECK(said(plant(R"({"name": "l", "device": "/dev/null"})", "2001")) ==
          "2 warning /lines/0 is read every 2001 ms at most, so that a member of the pair cannot tell by its silence "
          "for "
          "line_silence_ms whether the other one still works: read something more often, or raise line_silence_ms");
}

TEST_SUITE_END();
