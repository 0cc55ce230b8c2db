// The default maps of all models, copied from the manuals' tables (FX3 manual 9.3 in both editions, LS manual 7-2) and
// from nowhere else.
#include "bridge/plc/map_listing.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::address;
using modbus::table;

namespace {

// Where the printed devices do not begin or end with the register: CS200 inside its register, Y15 before its end.
struct manual_row {
    std::uint32_t first;
    std::uint32_t last;
    const char* head;
    const char* end;       // the last device; unused: null
    bool writable = true;  // coils or holding registers too
};

constexpr const char* unused = nullptr;

// clang-format off
const manual_row fx3s_bits[] = {
    {0x0000, 0x05FF, "M0",    "M1535"},
    {0x0600, 0x1DFF, unused,  unused},
    {0x1E00, 0x1FFF, "M8000", "M8511"},
    {0x2000, 0x20FF, "S0",    "S255"},
    {0x2100, 0x2FFF, unused,  unused},
    {0x3000, 0x3089, "TS0",   "TS137"},
    {0x308A, 0x31FF, unused,  unused},
    {0x3200, 0x321F, "CS0",   "CS31"},
    {0x3220, 0x32C7, unused,  unused},
    {0x32C8, 0x32FF, "CS200", "CS255"},
    {0x3300, 0x330D, "Y0",    "Y15"},
    {0x330E, 0x33FF, unused,  unused},
    {0x3400, 0x340F, "X0",    "X17", false},
    {0x3410, 0xFFFF, unused,  unused},
};

const manual_row fx3s_words[] = {
    {0x0000, 0x0BB7, "D0",    "D2999"},
    {0x0BB8, 0x1F3F, unused,  unused},
    {0x1F40, 0x213F, "D8000", "D8511"},
    {0x2140, 0xA13F, unused,  unused},
    {0xA140, 0xA1C9, "TN0",   "TN137"},
    {0xA1CA, 0xA33F, unused,  unused},
    {0xA340, 0xA35F, "CN0",   "CN31"},
    {0xA360, 0xA407, unused,  unused},
    {0xA408, 0xA477, "CN200", "CN255"},
    {0xA478, 0xA4D7, "M0",    "M1535"},
    {0xA4D8, 0xA657, unused,  unused},
    {0xA658, 0xA677, "M8000", "M8511"},
    {0xA678, 0xA687, "S0",    "S255"},
    {0xA688, 0xA777, unused,  unused},
    {0xA778, 0xA780, "TS0",   "TS137"},
    {0xA781, 0xA797, unused,  unused},
    {0xA798, 0xA799, "CS0",   "CS31"},
    {0xA79A, 0xA7A3, unused,  unused},
    {0xA7A4, 0xA7A7, "CS200", "CS255"},
    {0xA7A8, 0xA7A8, "Y0",    "Y15"},
    {0xA7A9, 0xA7B7, unused,  unused},
    {0xA7B8, 0xA7B8, "X0",    "X17", false},
    {0xA7B9, 0xFFFF, unused,  unused},
};

const manual_row fx3g_bits[] = {  // FX3GC too
    {0x0000, 0x1DFF, "M0",    "M7679"},
    {0x1E00, 0x1FFF, "M8000", "M8511"},
    {0x2000, 0x2FFF, "S0",    "S4095"},
    {0x3000, 0x313F, "TS0",   "TS319"},
    {0x3140, 0x31FF, unused,  unused},
    {0x3200, 0x32FF, "CS0",   "CS255"},
    {0x3300, 0x337F, "Y0",    "Y177"},
    {0x3380, 0x33FF, unused,  unused},
    {0x3400, 0x347F, "X0",    "X177", false},
    {0x3480, 0xFFFF, unused,  unused},
};

const manual_row fx3g_words[] = {
    {0x0000, 0x1F3F, "D0",    "D7999"},
    {0x1F40, 0x213F, "D8000", "D8511"},
    {0x2140, 0x7EFF, "R0",    "R23999"},
    {0x7F00, 0xA13F, unused,  unused},
    {0xA140, 0xA27F, "TN0",   "TN319"},
    {0xA280, 0xA33F, unused,  unused},
    {0xA340, 0xA407, "CN0",   "CN199"},
    {0xA408, 0xA477, "CN200", "CN255"},
    {0xA478, 0xA657, "M0",    "M7679"},
    {0xA658, 0xA677, "M8000", "M8511"},
    {0xA678, 0xA777, "S0",    "S4095"},
    {0xA778, 0xA78B, "TS0",   "TS319"},
    {0xA78C, 0xA797, unused,  unused},
    {0xA798, 0xA7A7, "CS0",   "CS255"},
    {0xA7A8, 0xA7AF, "Y0",    "Y177"},
    {0xA7B0, 0xA7B7, unused,  unused},
    {0xA7B8, 0xA7BF, "X0",    "X177", false},
    {0xA7C0, 0xFFFF, unused,  unused},
};

const manual_row fx3u_bits[] = {  // FX3UC too
    {0x0000, 0x1DFF, "M0",    "M7679"},
    {0x1E00, 0x1FFF, "M8000", "M8511"},
    {0x2000, 0x2FFF, "S0",    "S4095"},
    {0x3000, 0x31FF, "TS0",   "TS511"},
    {0x3200, 0x32FF, "CS0",   "CS255"},
    {0x3300, 0x33FF, "Y0",    "Y377"},
    {0x3400, 0x34FF, "X0",    "X377", false},
    {0x3500, 0xFFFF, unused,  unused},
};

const manual_row fx3u_words[] = {
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
    {0xA7B8, 0xA7C7, "X0",    "X377", false},
    {0xA7C8, 0xFFFF, unused,  unused},
};

const manual_row ls_coils[] = {  // decimal, as the manual prints them beside the hexadecimal ones
    {    0,  3071, "M0",    "M3071"},
    { 3072,  7679, unused,  unused},
    { 7680,  7935, "M8000", "M8255"},
    { 7936,  8191, unused,  unused},
    { 8192,  9191, "S0",    "S999"},
    { 9192, 12287, unused,  unused},
    {12288, 12543, "TS0",   "TS255"},
    {12544, 12799, unused,  unused},
    {12800, 13055, "CS0",   "CS255"},
    {13056, 13239, "Y0",    "Y267"},  // the manual: Y0-Y255
    {13240, 65535, unused,  unused},
};

const manual_row ls_discrete_inputs[] = {
    {    0, 13311, unused,  unused},
    {13312, 13495, "X0",    "X267"},  // the manual: X0-X255
    {13496, 65535, unused,  unused},
};

const manual_row ls_input_registers[] = {
    {    0, 65535, unused,  unused},
};

const manual_row ls_holding_registers[] = {
    {    0,  7999, "D0",    "D7999"},
    { 8000,  8255, "D8000", "D8255"},
    { 8256, 41279, unused,  unused},
    {41280, 41535, "TN0",   "TN255"},
    {41536, 41791, unused,  unused},
    {41792, 41991, "CN0",   "CN199"},
    {41992, 42103, "CN200", "CN255"},
    {42104, 65535, unused,  unused},
};
// clang-format on

using rows = std::span<const manual_row>;

struct manual_table {
    const char* model;
    table in;
    rows printed;
};

const manual_table manual_tables[] = {
    {"FX3S", table::discrete_inputs, fx3s_bits},          {"FX3S", table::coils, fx3s_bits},
    {"FX3S", table::input_registers, fx3s_words},         {"FX3S", table::holding_registers, fx3s_words},
    {"FX3G", table::discrete_inputs, fx3g_bits},          {"FX3G", table::coils, fx3g_bits},
    {"FX3G", table::input_registers, fx3g_words},         {"FX3G", table::holding_registers, fx3g_words},
    {"FX3GC", table::discrete_inputs, fx3g_bits},         {"FX3GC", table::coils, fx3g_bits},
    {"FX3GC", table::input_registers, fx3g_words},        {"FX3GC", table::holding_registers, fx3g_words},
    {"FX3U", table::discrete_inputs, fx3u_bits},          {"FX3U", table::coils, fx3u_bits},
    {"FX3U", table::input_registers, fx3u_words},         {"FX3U", table::holding_registers, fx3u_words},
    {"FX3UC", table::discrete_inputs, fx3u_bits},         {"FX3UC", table::coils, fx3u_bits},
    {"FX3UC", table::input_registers, fx3u_words},        {"FX3UC", table::holding_registers, fx3u_words},
    {"LS22", table::discrete_inputs, ls_discrete_inputs}, {"LS22", table::coils, ls_coils},
    {"LS22", table::input_registers, ls_input_registers}, {"LS22", table::holding_registers, ls_holding_registers},
    {"LS32", table::discrete_inputs, ls_discrete_inputs}, {"LS32", table::coils, ls_coils},
    {"LS32", table::input_registers, ls_input_registers}, {"LS32", table::holding_registers, ls_holding_registers},
};

bool is_used(const manual_table& of, const manual_row& row)
{
    const bool written = of.in == table::coils || of.in == table::holding_registers;
    return row.head != unused && (row.writable || !written);
}

class looked_at {
public:
    explicit looked_at(const manual_table& of)
        : of_(of), model_(*find_model(of.model)), memory_(model_), map_(modbus_map::standard(model_))
    {
    }

    // The first run of devices behind `count` numbers; nothing when one of them leads nowhere.
    std::optional<std::vector<extent>> found(std::uint32_t first, std::size_t count) const
    {
        return map_.find(memory_, of_.in, address(static_cast<std::uint16_t>(first)), count);
    }

    bool leads_to(std::uint32_t first, const place& expected) const
    {
        const auto runs = found(first, 1);
        return runs && runs->size() == 1 && runs->front().at == expected && runs->front().count == 1;
    }

    place at(const char* device) const { return memory_.find(*parse_device(device)).value(); }

    // The place of the first number whose last bits hold the device.
    place behind_last(const char* device) const
    {
        place p = at(device);
        const auto& area = model_.areas[p.area];
        if (!modbus::is_bit_table(of_.in))
            p.bit = area.bits_per_device == 32 ? p.bit + 16 : p.bit / 16 * 16;
        return p;
    }

    // And whose first bits hold it, in a register of bits.
    place before_first(const char* device) const
    {
        place p = at(device);
        if (!modbus::is_bit_table(of_.in) && model_.areas[p.area].bits_per_device == 1)
            p.bit = p.bit / 16 * 16;
        return p;
    }

private:
    const manual_table& of_;
    const model& model_;
    memory memory_;
    modbus_map map_;
};

}  // namespace

TEST_CASE("default maps: the first and the last number of every row lead to the manual's devices, unused ones nowhere")
{
    for (const manual_table& each : manual_tables) {
        const looked_at looked(each);
        std::uint32_t expected = 0;
        for (const manual_row& row : each.printed) {
            CAPTURE(each.model);
            CAPTURE(std::string(modbus::to_string(each.in)));
            CAPTURE(row.first);
            REQUIRE(row.first == expected);  // the table above leaves nothing out
            expected = row.last + 1;
            if (!is_used(each, row)) {
                CHECK_FALSE(looked.found(row.first, 1));
                CHECK_FALSE(looked.found(row.last, 1));
                CHECK_FALSE(looked.found((row.first + row.last) / 2, 1));
                continue;
            }
            CHECK(looked.leads_to(row.first, looked.before_first(row.head)));
            CHECK(looked.leads_to(row.last, looked.behind_last(row.end)));
            CHECK(looked.found(row.first, std::size_t{row.last} - row.first + 1)->size() == 1);
        }
        CHECK(expected == 0x10000);
    }
}

TEST_CASE("default maps: a read that touches an unused number gets nothing at all")
{
    for (const manual_table& each : manual_tables) {
        const looked_at looked(each);
        for (std::size_t i = 0; i + 1 < each.printed.size(); ++i) {
            const bool both = is_used(each, each.printed[i]) && is_used(each, each.printed[i + 1]);
            CAPTURE(each.model);
            CAPTURE(std::string(modbus::to_string(each.in)));
            CAPTURE(each.printed[i].last);
            CHECK(looked.found(each.printed[i].last, 2).has_value() == both);
        }
    }
}

TEST_CASE("default maps: the same rows, read backwards by the map's listing")
{
    for (const manual_table& each : manual_tables) {
        const model& m = *find_model(each.model);
        for (const manual_row& row : each.printed) {
            CAPTURE(each.model);
            CAPTURE(std::string(modbus::to_string(each.in)));
            CAPTURE(row.first);
            const auto first = target_of(m, m.standard_map, {each.in, row.first});
            const auto last = target_of(m, m.standard_map, {each.in, row.last});
            REQUIRE(first.has_value() == is_used(each, row));
            REQUIRE(last.has_value() == is_used(each, row));
            if (first) {
                CHECK(first->first == *parse_device(row.head));
                CHECK(last->last == *parse_device(row.end));
            }
        }
    }
}

TEST_SUITE_END();
