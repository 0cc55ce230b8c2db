#include "bridge/plc/memory.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;

TEST_CASE("model: found by name, upper or lower case")
{
    REQUIRE(find_model("FX3U") != nullptr);
    CHECK(find_model("FX3U")->name == "FX3U");
    CHECK(find_model("fx3u") == find_model("FX3U"));
    CHECK(find_model("Fx3uc")->name == "FX3UC");
    CHECK(find_model("FX3") == nullptr);
    CHECK(find_model("FX3UCX") == nullptr);
    CHECK(find_model("") == nullptr);
    for (const model* each : all_models())
        CHECK(find_model(each->name) == each);
}

TEST_CASE("model: each default map row lies within one area, and no number leads to two devices")
{
    for (const model* each : all_models()) {
        CAPTURE(std::string(each->name));
        const memory devices(*each);
        const map_row* before = nullptr;
        for (const map_row& row : each->standard_map) {
            CAPTURE(row.first);
            const auto head = devices.find(row.head);
            REQUIRE(head.has_value());
            CHECK(row.count > 0);
            CHECK(row.first + row.count <= 0x10000);
            const std::size_t bits = modbus::is_bit_table(row.table) ? row.count : std::size_t{16} * row.count;
            CHECK(bits <= (devices.bits_from(*head) + 15) / 16 * 16);  // FX3S: TS and Y end inside a register
            if (before != nullptr && before->table == row.table)
                CHECK(before->first + before->count <= row.first);
            before = &row;
        }
    }
}

TEST_CASE("model: areas of one kind do not overlap")
{
    for (const model* each : all_models())
        for (const area& one : each->areas)
            for (const area& other : each->areas)
                if (&one != &other && one.kind == other.kind)
                    CHECK((one.first + one.count <= other.first || other.first + other.count <= one.first));
}

TEST_SUITE_END();
