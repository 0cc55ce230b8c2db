// Routes and DDS blocks with the devices of an FP7.
#include "bridge/plc/models/fp7.hpp"
#include "bridge/plc_block.hpp"
#include "bridge/routes/route.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using modbus::table;

namespace {

class bench {
public:
    plc::place at(const char* device) const
    {
        return plc.memory().find(plc::parse_device(device, plc::fp7.names).value()).value();
    }

    route to(const char* device, table from, std::uint16_t count)
    {
        route r;
        r.plc = &plc;
        r.at = at(device);
        r.there = modbus_place{from, {}};
        r.count = count;
        return r;
    }

    plc_block block(const char* device, std::uint32_t count)
    {
        return {device, &plc, plc::parse_device(device, plc::fp7.names).value(), at(device), count};
    }

    plc::simulated_plc plc{"panel", plc::fp7, {}};
};

}  // namespace

TEST_CASE("fp7 route: registers go into DT and WR, bits into contacts across a word")
{
    bench b;
    plc::memory& memory = b.plc.memory();
    route data = b.to("DT100", table::holding_registers, 2);
    store(data, question_of(data), modbus::registers_read{{5, 6}});
    CHECK(memory.word(b.at("DT101")) == 6);
    route words = b.to("WR3", table::holding_registers, 1);
    store(words, question_of(words), modbus::registers_read{{0x8001}});
    CHECK(memory.bit(b.at("R30")));
    CHECK(memory.bit(b.at("R3F")));
    route contacts = b.to("R1F", table::coils, 2);
    store(contacts, question_of(contacts), modbus::bits_read{{true, true}});
    CHECK(memory.word(b.at("WR1")) == 0x8000);
    CHECK(memory.word(b.at("WR2")) == 0x0001);
}

TEST_CASE("fp7 route: a contact that changes touches the routes and blocks of its word, no other")
{
    bench b;
    b.plc.memory().set_bit(b.at("R3F"), true);
    const auto changes = b.plc.memory().take_changes();
    REQUIRE(changes.size() == 1);
    CHECK(touches(b.to("WR3", table::holding_registers, 1), b.plc, changes[0]));
    CHECK(touches(b.to("R3F", table::coils, 1), b.plc, changes[0]));
    CHECK_FALSE(touches(b.to("R3E", table::coils, 1), b.plc, changes[0]));
    CHECK_FALSE(touches(b.to("WR4", table::holding_registers, 1), b.plc, changes[0]));
    CHECK(touches(b.block("WR3", 1), b.plc, changes[0]));
    CHECK_FALSE(touches(b.block("R30", 15), b.plc, changes[0]));
}

TEST_CASE("fp7 route: blocks are published under the names of an FP7")
{
    bench b;
    b.plc.memory().set_word(b.at("WR3"), 0x8001);
    const sample words = sample_of(b.block("WR3", 1), wall_time{1});
    CHECK(words.area == "WR");
    CHECK(words.first == 3);
    CHECK(words.format == sample_format::words);
    CHECK(words.words == std::vector<std::uint16_t>{0x8001});
    const sample bits = sample_of(b.block("R3F", 2), wall_time{1});
    CHECK(bits.area == "R");
    CHECK(bits.first == 63);
    CHECK(bits.format == sample_format::bits);
    CHECK(bits.words == std::vector<std::uint16_t>{1});
    CHECK(sample_of(b.block("DT100", 1), wall_time{1}).area == "DT");
}

TEST_SUITE_END();
