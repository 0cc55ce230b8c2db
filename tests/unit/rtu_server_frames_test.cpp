// What a server makes of the frames on an RTU line: FX3 manual 7.2, 7.11.1 and 12.6 (errors 205 and 206). What it makes
// of damaged ones: damage_server_test.cpp.
#include "protocols/modbus/rtu.hpp"
#include "protocols/modbus/rtu_bus.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr duration silence = 20ms;
constexpr unit_id us{1};

using events = std::vector<bus_event>;

void take(rtu_bus_framer& in, time_point now, events& to)
{
    while (auto each = in.next(now))
        to.push_back(std::move(*each));
}

// Pieces a millisecond apart, silence before and behind them.
events receive(const pieces& received)
{
    events all;
    rtu_bus_framer in({us}, silence);
    take(in, t0 - 1s, all);
    take(in, t0 - 1s + silence, all);
    time_point now = t0;
    for (const bytes piece : received) {
        in.feed(now, piece);
        take(in, now, all);
        now += 1ms;
    }
    take(in, now + silence, all);
    return all;
}

bus_event question(const frame& f) { return {bus_event::kind::question, f, {}, f.pdu.size() + rtu_overhead}; }

bus_event dropped(errc why, std::size_t size) { return {bus_event::kind::dropped, {}, why, size}; }

}  // namespace

TEST_CASE("rtu server: a request is taken at every cut, known or not, to us or to all")
{
    const frame requests[] = {
        {us, {0x03, 0x00, 0x00, 0x00, 0x0A}},
        {unit_id::broadcast, {0x06, 0x00, 0x01, 0x00, 0x03}},
        {us, {0x07}},
        {us, {0x08, 0x00, 0x00, 0xA5, 0x37}},
        {us, {0x08, 0x00, 0x00, 1, 2, 3, 4}},  // any data: only the silence tells its length
        {us, {0x55, 0x01}},                    // unknown: it gets exception 01
        {us, {0x10, 0x00, 0x00, 0x00, 0x02, 0x04, 0x12, 0x34, 0x56, 0x78}},
    };
    for (const frame& each : requests)
        every_cut(encode_rtu(each), [&](const pieces& cut) { CHECK(receive(cut) == events{question(each)}); });
}

TEST_CASE("rtu server: three bytes are too short, 257 are too long, 256 are a frame")
{
    CHECK(receive(pieces{bytes(buffer{0x01, 0x03, 0x00})}) == events{dropped(errc::too_short, 3)});
    const frame longest{us, buffer(max_pdu_size, 0x55)};
    const buffer adu = encode_rtu(longest);
    REQUIRE(adu.size() == 256);
    CHECK(receive(pieces{bytes(adu)}) == events{question(longest)});
    const frame longer{us, buffer(max_pdu_size + 1, 0x55)};
    CHECK(receive(pieces{bytes(encode_rtu(longer))}) == events{dropped(errc::overlong, 257)});
}

TEST_SUITE_END();
