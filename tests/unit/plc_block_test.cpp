#include "bridge/plc/models/fx3u.hpp"
#include "bridge/plc_block.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using words = std::vector<std::uint16_t>;

namespace {

plc_block block_of(plc::simulated_plc& plc, const char* head, std::uint32_t count)
{
    const plc::device device = *plc::parse_device(head);
    return {std::string("main.") + head, &plc, device, plc.memory().find(device).value(), count};
}

}  // namespace

TEST_CASE("plc block: registers as they stand in the memory")
{
    plc::simulated_plc plc("main", plc::fx3u, {});
    const plc_block block = block_of(plc, "D100", 3);
    plc.memory().set_word(block.at, 0x1234);
    plc.memory().set_word({block.at.area, block.at.bit + 32}, 0xFFFF);

    const sample s = sample_of(block, wall_time{1'700'000'000'000'000'000});
    CHECK(s.route == "main.D100");
    CHECK(s.area == "D");
    CHECK(s.first == 100);
    CHECK(s.format == sample_format::words);
    CHECK(s.count == 3);
    CHECK(s.words == words{0x1234, 0, 0xFFFF});
    CHECK(s.state == quality::good);
    CHECK(s.source == wall_time{1'700'000'000'000'000'000});
}

TEST_CASE("plc block: bits are packed by 16, the lowest number in bit 0, wherever they begin")
{
    plc::simulated_plc plc("main", plc::fx3u, {});
    const plc_block block = block_of(plc, "X5", 20);  // X5-X30
    for (const char* on : {"X5", "X6", "X24", "X25", "X30", "X31"})
        plc.memory().set_bit(plc.memory().find(*plc::parse_device(on)).value(), true);

    const sample s = sample_of(block, wall_time{1});
    CHECK(s.area == "X");
    CHECK(s.first == 5);
    CHECK(s.format == sample_format::bits);
    CHECK(s.count == 20);
    CHECK(s.words == words{0x8003, 0x0009});
}

TEST_CASE("plc block: a 32-bit counter is two registers of its block")
{
    plc::simulated_plc plc("main", plc::fx3u, {});
    const plc_block block = block_of(plc, "CN200", 4);
    plc.memory().set_word({block.at.area, block.at.bit + 16}, 0x0001);
    const sample s = sample_of(block, wall_time{1});
    CHECK(s.area == "CN");
    CHECK(s.first == 200);
    CHECK(s.words == words{0, 1, 0, 0});
}

TEST_CASE("plc block: which changes touch it")
{
    plc::simulated_plc plc("main", plc::fx3u, {});
    const plc::simulated_plc other("other", plc::fx3u, {});
    const plc_block d = block_of(plc, "D100", 10);
    const std::size_t area = d.at.area;
    CHECK(touches(d, plc, {area, 16 * 100, 16}));
    CHECK(touches(d, plc, {area, 16 * 109, 16}));
    CHECK(touches(d, plc, {area, 0, 16 * 8000}));
    CHECK(touches(d, plc, {area, 16 * 99, 32}));
    CHECK_FALSE(touches(d, plc, {area, 16 * 99, 16}));
    CHECK_FALSE(touches(d, plc, {area, 16 * 110, 16}));
    CHECK_FALSE(touches(d, plc, {area + 1, 16 * 100, 16}));
    CHECK_FALSE(touches(d, other, {area, 16 * 100, 16}));

    const plc_block m = block_of(plc, "M20", 20);  // M20-M39
    CHECK_FALSE(touches(m, plc, {m.at.area, 19, 1}));
    CHECK(touches(m, plc, {m.at.area, 20, 1}));
    CHECK(touches(m, plc, {m.at.area, 39, 1}));
    CHECK_FALSE(touches(m, plc, {m.at.area, 40, 100}));
}

TEST_SUITE_END();
