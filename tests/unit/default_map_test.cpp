// The default map of the FX3U, FX3 manual 9.3, copied from the manual's text and from nowhere else.
#include "bridge/plc/modbus_map.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "tests/support/print.hpp"

#include <string>
#include <utility>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::address;
using modbus::table;

namespace {

struct manual_row {
    std::uint16_t first;
    std::uint16_t last;
    const char* head;
    const char* end;  // the last device
};

// clang-format off
const manual_row bit_rows[] = {  // discrete inputs and coils
    {0x0000, 0x1DFF, "M0",    "M7679"},
    {0x1E00, 0x1FFF, "M8000", "M8511"},
    {0x2000, 0x2FFF, "S0",    "S4095"},
    {0x3000, 0x31FF, "TS0",   "TS511"},
    {0x3200, 0x32FF, "CS0",   "CS255"},
    {0x3300, 0x33FF, "Y0",    "Y377"},
    {0x3400, 0x34FF, "X0",    "X377"},  // no coils
};

const manual_row word_rows[] = {  // input registers and holding registers
    {0x0000, 0x1F3F, "D0",    "D7999"},
    {0x1F40, 0x213F, "D8000", "D8511"},
    {0x2140, 0xA13F, "R0",    "R32767"},
    {0xA140, 0xA33F, "TN0",   "TN511"},
    {0xA340, 0xA407, "CN0",   "CN199"},
    {0xA408, 0xA477, "CN200", "CN255"},
    {0xA478, 0xA657, "M0",    "M7679"},
    {0xA658, 0xA677, "M8000", "M8511"},
    {0xA678, 0xA777, "S0",    "S4095"},
    {0xA778, 0xA797, "TS0",   "TS511"},
    {0xA798, 0xA7A7, "CS0",   "CS255"},
    {0xA7A8, 0xA7B7, "Y0",    "Y377"},
    {0xA7B8, 0xA7C7, "X0",    "X377"},  // no holding registers
};
// clang-format on

struct view {
    table in;
    std::span<const manual_row> rows;  // those that this table has
};

const view views[] = {
    {table::discrete_inputs, bit_rows},
    {table::coils, std::span(bit_rows).first(6)},
    {table::input_registers, word_rows},
    {table::holding_registers, std::span(word_rows).first(12)},
};

using runs = std::vector<std::pair<place, std::size_t>>;

struct fx3u_map {
    place at(const char* device) const { return m.find(*parse_device(device)).value(); }

    // Where numbers lead to; empty when one of them leads nowhere.
    runs find(table in, unsigned first, std::size_t count) const
    {
        runs found;
        for (const extent& each : map.find(m, in, address(first), count).value_or(std::vector<extent>{}))
            found.push_back({each.at, each.count});
        return found;
    }

    memory m{fx3u};
    modbus_map map = modbus_map::standard(fx3u);
};

std::size_t step_of(table t) { return modbus::is_bit_table(t) ? 1 : 16; }  // bits behind one number

}  // namespace

TEST_CASE("default map: first, last and all numbers of every row lead to the manual's devices, in all four tables")
{
    const fx3u_map f;
    for (const auto& [in, rows] : views)
        for (const manual_row& row : rows) {
            CAPTURE(std::string(modbus::to_string(in)));
            CAPTURE(row.head);
            const place head = f.at(row.head);
            const place end = f.at(row.end);
            const place last{head.area, end.bit + f.m.bits_from(end) - step_of(in)};
            const std::size_t count = std::size_t{row.last} - row.first + 1U;

            CHECK(f.find(in, row.first, 1) == runs{{head, 1}});
            CHECK(f.find(in, row.last, 1) == runs{{last, 1}});
            CHECK(f.find(in, row.first, count) == runs{{head, count}});
            CHECK(f.m.bits_from(head) == count * step_of(in));  // the row takes all of the area
        }
}

TEST_CASE("default map: a read may cross from one row to the next")
{
    const fx3u_map f;
    for (const auto& [in, rows] : views)
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            CAPTURE(rows[i].head);
            REQUIRE(rows[i].last + 1 == rows[i + 1].first);  // the FX3U's rows have no holes
            const auto left = f.find(in, rows[i].last, 1);
            const auto right = f.find(in, rows[i + 1].first, 1);
            CHECK(f.find(in, rows[i].last, 2) == runs{left[0], right[0]});
        }
}

TEST_CASE("default map: a long read runs over several rows")
{
    const fx3u_map f;
    CHECK(f.find(table::coils, 0x31FF, 0x102) == runs{{f.at("TS511"), 1}, {f.at("CS0"), 256}, {f.at("Y0"), 1}});
}

TEST_CASE("default map: behind the last row there is nothing, and X is never written")
{
    const fx3u_map f;
    for (const auto& [in, rows] : views) {
        CAPTURE(std::string(modbus::to_string(in)));
        const std::uint16_t last = rows.back().last;
        CHECK(f.find(in, last + 1U, 1).empty());
        CHECK(f.find(in, last, 2).empty());
        CHECK(f.find(in, 0xFFFF, 1).empty());
        CHECK(f.find(in, 0xFFFF, 2).empty());
    }
    CHECK(f.find(table::coils, 0x3400, 1).empty());
    CHECK(f.find(table::holding_registers, 0xA7B8, 1).empty());
}

TEST_CASE("default map: the FX3UC has the same one")
{
    CHECK(fx3uc.standard_map.data() == fx3u.standard_map.data());
    CHECK(fx3uc.standard_map.size() == std::size(bit_rows) * 2 - 1 + std::size(word_rows) * 2 - 1);
}

TEST_SUITE_END();
