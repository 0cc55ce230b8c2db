// FP7 manual 6.4: the formulas and the six examples. The manual rounds Ts, Tlt and Tlk before it adds them, so its
// totals are compared with the sum of its own rounded parts, and the parts with ours.
#include "bridge/plc_link_time.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace std::chrono_literals;

namespace {

struct example {
    std::size_t stations;  // that take part
    bool absent;
    link_load each;
    unsigned pcm;
    duration tpc, ts, tlt, tlk, total;  // as printed
};

// clang-format off
const example examples[] = {
    // stations       words      scan   Pcm  Tpc      Ts       Tlt     Tlk    T
    {16, false, {4,  8,    1ms},  71,  6820us,  7820us, 4320us, 0ms,   130440us},
    {16, false, {4,  8,    5ms},  71,  6820us, 11820us, 4320us, 0ms,   198440us},
    {15, true,  {4,  8,    5ms},  71,  6820us, 11820us, 4130us, 407ms, 593430us},
    {8,  false, {8,  16,   5ms}, 119, 11430us, 16430us, 2790us, 0ms,   139230us},  // its line forgets "x 8", not its T
    {2,  false, {32, 64,   5ms}, 407, 39072us, 44072us, 1632us, 0ms,    94776us},
    {2,  false, {1,  1,    1ms},  31,  2976us,  3976us, 1632us, 0ms,    10584us},
};
// clang-format on

bool rounds_to(duration t, duration printed, duration half_a_step)
{
    return t >= printed - half_a_step && t <= printed + half_a_step;
}

plc_link_time computed(const example& e)
{
    const std::vector<link_load> stations(e.stations, e.each);
    return round_time({.stations = stations, .master_scan = e.each.scan, .somebody_absent = e.absent});
}

}  // namespace

TEST_CASE("plc link time: a byte is 0.096 ms at 115200 bit/s")
{
    CHECK(link_byte_time(115200) == 96us);
    CHECK(link_byte_time(9600) == 1146us);
}

TEST_CASE("plc link time: the parts of the manual's six examples")
{
    for (const example& e : examples) {
        CAPTURE(e.total);
        const plc_link_time t = computed(e);
        CHECK(link_bytes(e.each) == e.pcm);
        CHECK(rounds_to(link_send_time(e.each), e.tpc, 6us));  // 11.424 is printed as 11.43
        REQUIRE(t.ts.size() == e.stations);
        for (const duration each : t.ts)
            CHECK(rounds_to(each, e.ts, 6us));
        CHECK(rounds_to(t.tlt, e.tlt, 6us));  // 2.784 is printed as 2.79
        CHECK(t.tso == e.each.scan);
        CHECK(rounds_to(t.tlk, e.tlk, 500us));
    }
}

TEST_CASE("plc link time: the totals of the manual's six examples are the sums of its parts")
{
    for (const example& e : examples) {
        CAPTURE(e.total);
        const plc_link_time printed{std::vector<duration>(e.stations, e.ts), e.tlt, e.each.scan, e.tlk};
        CHECK(printed.total() == e.total);
        const duration rounding = static_cast<std::int64_t>(e.stations + 1) * 6us + (e.absent ? 500us : 0us);
        CHECK(rounds_to(computed(e).total(), e.total, rounding));
    }
    CHECK(computed(examples[4]).total() == 94776us);
    CHECK(computed(examples[5]).total() == 10584us);
}

TEST_CASE("plc link time: whoever is absent costs the waiting time and the scan of the master once more")
{
    CHECK(link_join_time(5ms) == 960us + 400ms + 672us + 5ms);
    CHECK(link_join_time(5ms, 100ms) == 960us + 100ms + 672us + 5ms);
    const std::vector<link_load> unequal{{1, 0, 2ms}, {0, 3, 7ms}};
    const plc_link_time t = round_time({.stations = unequal, .master_scan = 2ms});
    CHECK(t.ts == std::vector<duration>{2ms + 27 * 96us, 7ms + 35 * 96us});
    CHECK(t.tlk == 0us);
}

TEST_SUITE_END();
