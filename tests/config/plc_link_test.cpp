// Mistakes in the stations of PLC links.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// Each row of links on a line of its own, from line 3 on.
std::string linked(const std::string& rows, const char* more = "")
{
    return R"({"plcs": [{"name": "p", "model": "FP7"}, {"name": "q", "model": "FP7"}, {"name": "f", "model": "FX3U"}],
"plc_links": [
)" + rows + "\n]" +
           more + "}";
}

}  // namespace

TEST_CASE("check: stations of a PLC link")
{
    const struct {
        const char* rows;
        const char* expected;
    } rows[] = {
        {R"({"name": "l", "plc": "p", "station": 1, "relay_count": 64, "register_count": 127})", ""},
        {R"({"name": "l", "plc": "p", "station": 1, "relay_count": 20},
{"name": "l", "plc": "q", "station": 2, "relay_first": 20, "relay_count": 44},
{"name": "m", "plc": "p", "station": 1, "block": 1, "relay_count": 20})",
         ""},
        {R"({"name": "l", "plc": "f", "station": 1})",
         R"(3 /plc_links/0/plc names "f", a FX3U: only an FP7 has link relays and link registers)"},
        {R"({"name": "l", "plc": "r", "station": 1})",
         R"(3 /plc_links/0/plc names the PLC "r", which does not exist: did you mean "p"?)"},
        {R"({"name": "l", "plc": "p", "station": 17})",
         "3 /plc_links/0/station is 17, expected a whole number from 1 to 16"},
        {R"({"name": "l", "plc": "p"})",
         R"(3 /plc_links/0 has no "station": Its number, which no other station of the link has)"},
        {R"({"name": "l", "plc": "p", "station": 5, "max_station": 4})",
         "3 /plc_links/0/station is 5, above the highest station of this PLC, which is 4"},
        {R"({"name": "l", "plc": "p", "station": 1, "relay_first": 60, "relay_count": 5})",
         "3 /plc_links/0/relay_count sends WL60-WL64, but this PLC uses only 64 words for the link: raise relay_words"},
        {R"({"name": "l", "plc": "p", "station": 2},
{"name": "l", "plc": "q", "station": 2})",
         "4 /plc_links/1/station is 2 a second time: each station has its own number, and one send area"},
        {R"({"name": "l", "plc": "p", "station": 1, "register_count": 5},
{"name": "m", "plc": "f", "station": 2},
{"name": "l", "plc": "q", "station": 2, "register_first": 4, "register_count": 5})",
         "4 /plc_links/1/plc names \"f\", a FX3U: only an FP7 has link relays and link registers\n"
         "5 /plc_links/2/register_first sends LD4-LD8, which overlaps with LD0-LD4 of station 1"},
        {R"({"name": "l", "plc": "p", "station": 1},
{"name": "l", "plc": "p", "station": 2, "block": 1})",
         R"(4 /plc_links/1/plc names "p", which is a station of this link already)"},
        {R"({"name": "l", "plc": "p", "station": 1, "block": 1},
{"name": "m", "plc": "p", "station": 1, "block": 1})",
         R"(4 /plc_links/1/block is 1, which the link "l" uses in "p": each link has a block of its own)"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.rows));
        CHECK(said(linked(row.rows)) == row.expected);
    }
}

TEST_CASE("check: a PLC link needs DDS")
{
    CHECK(said(linked(R"({"name": "l", "plc": "p", "station": 1})", R"(,
"dds": {"enabled": false})")) ==
          "5 /dds/enabled is false, but DDS is what carries the PLC links: switch it on or remove them");
}

TEST_SUITE_END();
