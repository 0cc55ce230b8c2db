// The map read both ways, and the questions that `plc-gateway map` understands.
#include "bridge/plc/map_query.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::table;

namespace {

const model& fx3u = *find_model("FX3U");

device dev(const char* text) { return parse_device(text).value(); }

std::vector<device_address> where(const char* model_name, const char* text)
{
    const model& m = *find_model(model_name);
    return addresses_of(m, m.standard_map, dev(text));
}

std::optional<map_target> behind(const char* model_name, table t, std::uint32_t number)
{
    const model& m = *find_model(model_name);
    return target_of(m, m.standard_map, {t, number});
}

using places = std::vector<device_address>;

}  // namespace

TEST_CASE("map listing: a device is found in every table that has it")
{
    CHECK(where("FX3U", "D8015") ==
          places{{{table::input_registers, 0x1F4F}, 1, {}}, {{table::holding_registers, 0x1F4F}, 1, {}}});
    CHECK(where("FX3U", "M17") == places{{{table::coils, 17}, 1, {}},
                                         {{table::discrete_inputs, 17}, 1, {}},
                                         {{table::input_registers, 0xA479}, 1, 1},
                                         {{table::holding_registers, 0xA479}, 1, 1}});
    CHECK(where("FX3U", "X17") ==
          places{{{table::discrete_inputs, 0x340F}, 1, {}}, {{table::input_registers, 0xA7B8}, 1, 15}});
    CHECK(where("FX3U", "CN201") ==
          places{{{table::input_registers, 0xA40A}, 2, {}}, {{table::holding_registers, 0xA40A}, 2, {}}});
}

TEST_CASE("map listing: devices that no number leads to, and devices that do not exist")
{
    CHECK(where("LS22", "D8400").empty());
    CHECK(where("LS22", "X0") == places{{{table::discrete_inputs, 0x3400}, 1, {}}});
    CHECK(where("FX3G", "R24000").empty());
    CHECK(where("FX3S", "CS192").empty());  // fills up the register of CS200
    CHECK(where("FX3S", "CS200") == places{{{table::coils, 0x32C8}, 1, {}},
                                           {{table::discrete_inputs, 0x32C8}, 1, {}},
                                           {{table::input_registers, 0xA7A4}, 1, 8},
                                           {{table::holding_registers, 0xA7A4}, 1, 8}});
}

TEST_CASE("map listing: a number leads to a device, to 16 bits, or to half of a counter")
{
    using part = map_target::part;
    CHECK(behind("FX3U", table::holding_registers, 0) == map_target{dev("D0"), dev("D0")});
    CHECK(behind("FX3U", table::coils, 0x330F) == map_target{dev("Y17"), dev("Y17")});
    CHECK(behind("FX3U", table::holding_registers, 0xA478) == map_target{dev("M0"), dev("M15")});
    CHECK(behind("FX3U", table::holding_registers, 0xA408) ==
          map_target{dev("CN200"), dev("CN200"), 0, part::low_word});
    CHECK(behind("FX3U", table::holding_registers, 0xA477) ==
          map_target{dev("CN255"), dev("CN255"), 0, part::high_word});
    CHECK(behind("FX3S", table::holding_registers, 0xA7A4) == map_target{dev("CS200"), dev("CS207"), 8});
    CHECK(behind("FX3S", table::holding_registers, 0xA7A8) == map_target{dev("Y0"), dev("Y15")});
    CHECK_FALSE(behind("FX3U", table::coils, 0x3400));
    CHECK_FALSE(behind("LS32", table::input_registers, 0));
}

TEST_CASE("map listing: the user-defined allocation is read the same way")
{
    const model& m = *find_model("FX3U");
    allocation sets{};
    sets[0] = 0xC002;  // 32 registers from D100
    sets[1] = 100;
    sets[2] = 0x4001;  // 16 coils from Y20
    sets[3] = 20;      // octal
    sets[4] = 0x6001;  // one register from M32
    sets[5] = 32;
    sets[6] = 0xC001;  // D100 once more
    sets[7] = 100;
    std::optional<allocation_fault> fault;
    const modbus_map map = modbus_map::user_defined(m, sets, fault);
    REQUIRE_FALSE(fault);

    CHECK(target_of(m, map.rows(), {table::holding_registers, 31}) == map_target{dev("D131"), dev("D131")});
    CHECK(target_of(m, map.rows(), {table::holding_registers, 32}) == map_target{dev("M32"), dev("M47")});
    CHECK(target_of(m, map.rows(), {table::coils, 1}) == map_target{dev("Y21"), dev("Y21")});
    CHECK_FALSE(target_of(m, map.rows(), {table::coils, 16}));
    CHECK(addresses_of(m, map.rows(), dev("D100")) == places{{{table::input_registers, 100}, 1, {}},
                                                             {{table::holding_registers, 0}, 1, {}},
                                                             {{table::holding_registers, 33}, 1, {}}});
    CHECK(addresses_of(m, map.rows(), dev("D0")) == places{{{table::input_registers, 0}, 1, {}}});
}

TEST_CASE("map listing: names are the model's")
{
    const model& ls = *find_model("LS22");
    const model& fx3s = *find_model("FX3S");
    CHECK(name_of(ls, dev("TS5")) == "T5");
    CHECK(name_of(ls, dev("CN200")) == "C200");
    CHECK(name_of(ls, dev("Y267")) == "Y267");
    CHECK(name_of(fx3s, dev("TS5")) == "TS5");
    CHECK(names_of(fx3s, dev("M0"), dev("M15")) == "M0-M15");
    CHECK(ranges_of(fx3s, device_kind::cs) == "CS0-CS31, CS200-CS255");
    CHECK(ranges_of(fx3s, device_kind::y) == "Y0-Y15");
    CHECK(ranges_of(fx3s, device_kind::r).empty());
}

TEST_CASE("map listing: references are counted from 1, with five digits as far as they reach")
{
    CHECK(reference_of({table::holding_registers, 0}).five_digits == "40001");
    CHECK(reference_of({table::holding_registers, 0}).six_digits == "400001");
    CHECK(reference_of({table::coils, 9998}).five_digits == "09999");
    CHECK(reference_of({table::coils, 9999}).five_digits.empty());
    CHECK(reference_of({table::coils, 9999}).six_digits == "010000");
    CHECK(reference_of({table::discrete_inputs, 17}).five_digits == "10018");
    CHECK(reference_of({table::input_registers, 0xFFFF}).six_digits == "365536");
}

TEST_CASE("map query: numbers and references")
{
    const std::pair<const char*, map_address> rows[] = {
        {"40001", {table::holding_registers, 0}},
        {"400001", {table::holding_registers, 0}},
        {"465536", {table::holding_registers, 65535}},
        {"48016", {table::holding_registers, 8015}},
        {"30001", {table::input_registers, 0}},
        {"10018", {table::discrete_inputs, 17}},
        {"00001", {table::coils, 0}},
        {"000010", {table::coils, 9}},
        {"hr:0", {table::holding_registers, 0}},
        {"HR:0x1F4F", {table::holding_registers, 0x1F4F}},
        {"coil:5", {table::coils, 5}},
        {"ir:65535", {table::input_registers, 65535}},
        {"di:0xffff", {table::discrete_inputs, 65535}},
        {"holding:7", {table::holding_registers, 7}},
    };
    for (const auto& [text, expected] : rows) {
        CAPTURE(text);
        const auto query = parse_map_query(text, fx3u);
        REQUIRE(query.has_value());
        CHECK(std::get<map_address>(*query) == expected);
    }
}

TEST_CASE("map query: devices, X and Y in octal, T and C as contact and value")
{
    using devices = std::vector<device>;
    CHECK(std::get<devices>(*parse_map_query("D8015", fx3u)) == devices{dev("D8015")});
    CHECK(std::get<devices>(*parse_map_query("x17", fx3u)) == devices{{device_kind::x, 15}});
    CHECK(std::get<devices>(*parse_map_query("T5", fx3u)) == devices{dev("TS5"), dev("TN5")});
    CHECK(std::get<devices>(*parse_map_query("c200", fx3u)) == devices{dev("CS200"), dev("CN200")});
    CHECK(std::get<devices>(*parse_map_query("TN5", fx3u)) == devices{dev("TN5")});
}

TEST_CASE("map query: a wrong one says what would be right")
{
    const std::pair<const char*, const char*> rows[] = {
        {"", "expected a device"},
        {"D", "expected a device"},
        {"Q5", "expected a device"},
        {"T", "expected a device"},
        {"TX5", "expected a device"},
        {"D-1", "expected a device"},
        {"X8", "octal"},
        {"Y19", "octal"},
        {"5", "which table? Write hr:5"},
        {"4001", "which table?"},
        {"40000", "40001 is the first"},
        {"400000", "400001 is the first"},
        {"465537", "from 1 to 65536"},
        {"20001", "no reference"},
        {"900001", "no reference"},
        {"hr:", "no MODBUS number"},
        {"hr:65536", "0 to 65535"},
        {"hr:0x", "no MODBUS number"},
        {"hr:-1", "no MODBUS number"},
        {"hr:1x", "no MODBUS number"},
        {"zz:1", "no table: coil, di, ir or hr"},
        {":1", "no table"},
        {"hr:99999999999", "0 to 65535"},
    };
    for (const auto& [text, part] : rows) {
        CAPTURE(text);
        const auto query = parse_map_query(text, fx3u);
        REQUIRE(query.has_error());
        CHECK(query.error().find(part) != std::string::npos);
    }
}

TEST_SUITE_END();
