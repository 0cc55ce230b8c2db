// Mistakes with an FP7 in the configuration: its devices, its status, its lack of a program, its COM ports.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

namespace {

// A route of `count` items of a table to a device of an FP7, which stands on line 5.
std::string routed(const char* table, unsigned count, const std::string& device, const char* way = "read")
{
    return R"({"plcs": [{"name": "p", "model": "FP7"}], "lines": [{"name": "l", "device": "d"}],
"stations": [{"name": "s", "line": "l", "unit": 1}],
"routes": [{"name": "r", "station": "s", "plc": "p", "first": 0, "direction": ")" +
           std::string(way) + "\", \"table\": \"" + table + "\", \"count\": " + std::to_string(count) +
           ",\n\n\"device\": \"" + device + "\"}]}";
}

// A second route behind the first.
std::string routed_twice(const char* first, const char* second)
{
    return changed("}]}",
                   R"(},
{"name": "q", "station": "s", "plc": "p", "first": 9, "table": "holding", "device": ")" +
                       std::string(second) + "\"}]}",
                   routed("holding", 1, first));
}

}  // namespace

TEST_CASE("check: routes into the devices of an FP7")
{
    const struct {
        const char* table;
        unsigned count;
        const char* device;
        const char* expected;
    } rows[] = {
        {"holding", 4, "DT100", ""},
        {"coil", 1, "R1F", ""},
        {"holding", 1, "WR3", ""},
        {"holding", 2, "TE5", ""},
        {"holding", 1, "LD16383", ""},
        {"holding", 2, "LD16383",
         "5 /routes/0/device is LD16383, but from there the count goes beyond LD16383, the last one"},
        {"holding", 1, "WR2047", ""},
        {"holding", 2, "WR2047",
         "5 /routes/0/device is WR2047, but from there the count goes beyond WR2047, the last one"},
        {"coil", 2, "R2047F",
         "5 /routes/0/device is R2047F, but from there the count goes beyond R2047F, the last one"},
        {"holding", 1, "WX512", "5 /routes/0/device is WX512, which a FP7 does not have"},
        {"holding", 1, "DT65536", "5 /routes/0/device is DT65536, which a FP7 does not have"},
        {"holding", 1, "D100", R"(5 /routes/0/device is "D100", expected a device such as DT100, R1F or WR3)"},
        {"holding", 1, "R1G", R"(5 /routes/0/device is "R1G", expected a device such as DT100, R1F or WR3)"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.table) << " " << row.count << " " << std::string(row.device));
        CHECK(said(routed(row.table, row.count, row.device)) == row.expected);
    }
}

TEST_CASE("check: an FP7's own status is not for routes to write")
{
    const struct {
        const char* table;
        unsigned count;
        const char* device;
        const char* run;  // empty: allowed
    } rows[] = {
        {"coil", 1, "X1F", "X0-X1F"},    {"coil", 1, "X20", ""},
        {"holding", 1, "WX1", "X0-X1F"}, {"holding", 1, "WX2", ""},
        {"coil", 1, "YF", "Y0-YF"},      {"coil", 1, "Y10", ""},  // a reset from afar
        {"holding", 1, "WY0", "Y0-YF"},  {"holding", 1, "UM299", "UM0-UM299"},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.device));
        const std::string run = row.run;
        CHECK(said(routed(row.table, row.count, row.device)) ==
              (run.empty() ? ""
                           : "5 /routes/0/device reaches into " + run +
                                 ", where a FP7 shows its own communication: choose other devices"));
        const char* const writable = std::string(row.table) == "coil" ? "coil" : "holding";
        CHECK(said(routed(writable, row.count, row.device, "write")) == "");  // reading it is what it is for
    }
}

TEST_CASE("check: a word of contacts and its contacts overlap")
{
    CHECK(said(routed_twice("WR3", "R3F")) ==
          "6 /routes/1/device overlaps with the devices of route \"r\": each device has one source");
    CHECK(said(routed_twice("WR3", "R40")) == "");
    CHECK(said(routed_twice("WR3", "WL3")) == "");
}

TEST_CASE("check: an FP7 has no program")
{
    const auto plc = [](const char* more) {
        return R"({"plcs": [{"name": "p", "model": "FP7",)" + std::string(more) + "}]}";
    };
    CHECK(said(plc(R"(
"program": ["LD M8411", "MOV K1 D8414"])")) ==
          "2 /plcs/0/program does not belong to a FP7, which has neither D8400-D8485 nor ADPRW: remove it, the lines "
          "say how it communicates");
    CHECK(said(plc(R"("program": [])")) == "");
}

TEST_CASE("check: a server line stands for COM.0, COM.1 or COM.2 of an FP7")
{
    const auto served = [](const char* model, const char* channel) {
        return R"({"plcs": [{"name": "p", "model": ")" + std::string(model) + R"("}],
"lines": [{"name": "l", "device": "d", "role": "server", "units": [{"unit": 1, "plc": "p", "channel": )" +
               channel + "}]}]}";
    };
    for (const char* com : {"0", "1", "2"})
        CHECK(said(served("FP7", com)) == "");
    CHECK(said(served("FP7", "3")) == "2 /lines/0/units/0/channel is a channel that a FP7 does not have");
    CHECK(said(served("FX3U", "0")) == "2 /lines/0/units/0/channel is a channel that a FX3U does not have");
}

TEST_CASE("check: blocks of an FP7 are named as its devices are")
{
    const auto block = [](const char* device, const char* count) {
        return R"({"plcs": [{"name": "p", "model": "FP7"}], "dds": {"blocks": [{"plc": "p", "device": ")" +
               std::string(device) + R"(", "count": )" + count + "}]}}";
    };
    CHECK(said(block("R1F", "1")) == "");
    CHECK(said(block("WX0", "2")) == "");
    CHECK(said(block("UM150", "7")) == "");
    CHECK(said(block("UM299", "2")) ==
          "1 /dds/blocks/0/device is UM299, but from there the count goes beyond UM299, the last one");
}

TEST_SUITE_END();
