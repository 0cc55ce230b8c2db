// The user-defined allocation D8470-D8485, FX3 manual 9.4.
#include "bridge/plc/modbus_map.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::address;
using modbus::table;

namespace {

struct allocated {
    explicit allocated(allocation wanted) : sets(wanted), map(modbus_map::user_defined(fx3u, sets, fault)) {}

    // "32 M128": what stands behind a number, and how many follow it in the same run up to `count`.
    std::optional<device> device_at(table in, unsigned number) const
    {
        const auto found = map.find(m, in, address(number), 1);
        if (!found)
            return std::nullopt;
        const place at = found->front().at;
        const area& of = fx3u.areas[at.area];
        return device{of.kind, of.first + static_cast<std::uint32_t>(at.bit / of.bits_per_device)};
    }
    bool leads(table in, unsigned number, const char* to) const { return device_at(in, number) == parse_device(to); }

    // Coils keep the default only together with holding registers.
    bool is_default() const
    {
        return leads(table::coils, 0x3300, "Y0") && leads(table::holding_registers, 0x1F40, "D8000");
    }

    memory m{fx3u};
    allocation sets;
    std::optional<allocation_fault> fault;
    modbus_map map;
};

constexpr allocation valid_example{0x5002, 0,    0x0004, 128, 0x8008, 0,   0x9002, 128,
                                   0xC00D, 1000, 0xD010, 0,   0xF008, 200, 0,      0};

}  // namespace

TEST_CASE("user map: the manual's valid example, 9.4.2")
{
    const allocated a(valid_example);
    CHECK_FALSE(a.fault.has_value());
    CHECK(a.sets == valid_example);

    struct {
        table in;
        unsigned first;
        unsigned last;
        const char* head;
        const char* end;  // 16 bit devices in a register: the first of the last 16
    } const rows[] = {
        {table::coils, 0x0000, 0x001F, "X0", "X37"},
        {table::coils, 0x0020, 0x005F, "M128", "M191"},
        {table::holding_registers, 0x0000, 0x0007, "TS0", "TS112"},
        {table::holding_registers, 0x0008, 0x0009, "CS128", "CS144"},
        {table::holding_registers, 0x000A, 0x00D9, "D1000", "D1207"},
        {table::holding_registers, 0x00DA, 0x01D9, "R0", "R255"},
        {table::holding_registers, 0x01DA, 0x01E9, "CN200", "CN207"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.head);
        CHECK(a.leads(row.in, row.first, row.head));
        CHECK(a.leads(row.in, row.last, row.end));
        const auto whole = a.map.find(a.m, row.in, address(row.first), row.last - row.first + 1);
        REQUIRE(whole.has_value());
        CHECK(whole->size() == 1);
    }
    CHECK_FALSE(a.device_at(table::coils, 0x0060).has_value());
    CHECK_FALSE(a.device_at(table::holding_registers, 0x01EA).has_value());
    CHECK(a.map.find(a.m, table::coils, address{0x1F}, 2)->size() == 2);  // from X37 to M128
}

TEST_CASE("user map: the manual's invalid example, 9.4.2: the sets before the error stay, the others are 0")
{
    allocation sets = valid_example;
    sets[7] = 240;      // CS240-CS271
    sets[12] = 0xF010;  // 16 counters here
    const allocated a(sets);

    REQUIRE(a.fault.has_value());
    CHECK(a.fault->detail == 8476);
    CHECK(a.fault->reason == "CS240-CS271 exceeds the range of this PLC, which ends at CS255");
    CHECK(a.sets == allocation{0x5002, 0, 0x0004, 128, 0x8008, 0});

    CHECK(a.leads(table::coils, 0x1F, "X37"));
    CHECK(a.leads(table::coils, 0x5F, "M191"));
    CHECK_FALSE(a.device_at(table::coils, 0x60).has_value());
    CHECK(a.leads(table::holding_registers, 7, "TS112"));
    CHECK_FALSE(a.device_at(table::holding_registers, 8).has_value());
}

TEST_CASE("user map: discrete inputs and input registers always keep the default")
{
    const allocated a(valid_example);
    CHECK(a.leads(table::discrete_inputs, 0x0000, "M0"));
    CHECK(a.leads(table::discrete_inputs, 0x34FF, "X377"));
    CHECK(a.leads(table::input_registers, 0x0000, "D0"));
    CHECK(a.leads(table::input_registers, 0xA408, "CN200"));
    CHECK(a.leads(table::input_registers, 0xA7B8, "X0"));
}

TEST_CASE("user map: a first set that is invalid leaves the default map in force")
{
    const allocated a({0x9002, 240, 0x5002, 0});
    REQUIRE(a.fault.has_value());
    CHECK(a.fault->detail == 8470);
    CHECK(a.sets == allocation{});
    CHECK(a.is_default());
}

TEST_CASE("user map: no set, or a first set of size 0, is the default map and no error")
{
    for (const allocation& sets :
         {allocation{}, allocation{0x5000, 0, 0x0004, 128}, allocation{0x0000, 4, 0x0004, 128}}) {
        const allocated a(sets);
        CHECK_FALSE(a.fault.has_value());
        CHECK(a.is_default());
    }
}

TEST_CASE("user map: a set of size 0 ends the list")
{
    const allocated a({0x0001, 0, 0x1000, 3, 0x1001, 0, 0xFFFF, 0xFFFF});
    CHECK_FALSE(a.fault.has_value());
    CHECK(a.leads(table::coils, 15, "M15"));
    CHECK_FALSE(a.device_at(table::coils, 16).has_value());
}

TEST_CASE("user map: one kind of table defined leaves the other empty")
{
    const allocated a({0xD001, 100});
    CHECK(a.leads(table::holding_registers, 0, "R100"));
    CHECK_FALSE(a.device_at(table::holding_registers, 16).has_value());
    CHECK_FALSE(a.device_at(table::coils, 0).has_value());
}

TEST_CASE("user map: all eight sets, coils and registers counted apart")
{
    const allocated a({0x0001, 0, 0x6001, 0, 0x1001, 8, 0x7001, 16, 0x2001, 0, 0xE001, 5, 0x4001, 0, 0xF001, 255});
    CHECK_FALSE(a.fault.has_value());
    const char* const coils[] = {"M0", "S8", "TS0", "Y0"};
    const char* const registers[] = {"M0", "S16", "TN5", "CN255"};
    for (unsigned i = 0; i < 4; ++i) {
        CHECK(a.leads(table::coils, 16 * i, coils[i]));
        CHECK(a.leads(table::holding_registers, i, registers[i]));
    }
    CHECK(a.leads(table::coils, 63, "Y17"));
    CHECK_FALSE(a.device_at(table::coils, 64).has_value());
    CHECK(a.leads(table::holding_registers, 4, "CN255"));  // the high word
    CHECK_FALSE(a.device_at(table::holding_registers, 5).has_value());
}

TEST_CASE("user map: a set that is not the last one and invalid stops the rest")
{
    const allocated a({0x0001, 0, 0x0001, 4, 0x0001, 16});
    REQUIRE(a.fault.has_value());
    CHECK(a.fault->detail == 8472);
    CHECK(a.sets == allocation{0x0001, 0});
    CHECK_FALSE(a.device_at(table::coils, 16).has_value());
}

TEST_SUITE_END();
