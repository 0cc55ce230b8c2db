// An RTU line on which we are server beside others: noise, damage, babble and silence.
#include "tests/unit/framing_bus_bench.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

TEST_CASE("rtu bus: noise between frames is dropped, and costs no request")
{
    const buffer noises[] = {
        {0x00}, {0xFF},       {0xFF, 0x00, 0xFF},           {0x05},          {0x05, 0x03}, {0x05, 0x03, 0x10},
        {0x01}, {0x01, 0x03}, {0x11, 0x10, 0, 0, 0, 8, 16}, buffer(60, 0x55)};
    for (const buffer& noise : noises) {
        CAPTURE(noise);
        events expected{to_us};
        for (const buffer& received : {noise + adu(to_us), adus({to_neighbour}) + noise + adu(to_us),
                                       adus({to_neighbour, from_neighbour}) + noise + adu(to_us)})
            every_cut(received, [&](const pieces& cut) {
                const events all = receive(cut);
                REQUIRE(!all.empty());
                CHECK(all.back() == to_us);
                std::size_t dropped = 0;
                for (const bus_event& each : all)
                    dropped += each.what == bus_event::kind::dropped ? each.size : 0;
                CHECK(dropped == noise.size());
            });
        // Before and behind a response: neighbours alone bring the framer back into step.
        const events talk = receive(adu(to_neighbour) + noise + adus({from_neighbour, to_neighbour, from_neighbour}));
        CHECK(std::count(talk.begin(), talk.end(), from_neighbour) == 2);
    }
    for (const std::uint8_t each : buffer{0x00, 0x03, 0x55, 0xA5, 0xFF})
        CHECK(receive(buffer(700, each) + adu(to_us)).back() == to_us);
    // A transceiver that turns round behind the request, which is not believed before there is silence.
    CHECK(receive(buffer{0xFF} + adu(to_us) + buffer{0x00}) ==
          events{drops(errc::too_short, 1), to_us, drops(errc::too_short, 1)});
    CHECK(receive(adu(to_us) + buffer{0x00}) == events{to_us, drops(errc::too_short, 1)});
}

TEST_CASE("rtu bus: every damaged frame is dropped once, and says why (FX3 errors 205 and 206)")
{
    const buffer whole = adu(to_us);
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        buffer flipped = whole;
        flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ 1U << (bit % 8));
        const events all = receive(flipped);
        REQUIRE(all.size() == 1);
        CHECK(all[0].what == bus_event::kind::dropped);
        CHECK(all[0].size == whole.size());
        CHECK((all[0].why == errc::bad_checksum || all[0].why == errc::incomplete));  // incomplete: another function
    }
    for (std::size_t size = 1; size < whole.size(); ++size)
        CHECK(receive(bytes(whole).first(size)) == events{drops(size <= 3 ? errc::too_short : errc::incomplete, size)});
    check(buffer(30, 0x55), {drops(errc::bad_checksum, 30)});
    CHECK(receive(buffer(300, 0x55)) == events{drops(errc::overlong, 300)});
    CHECK(receive(buffer(257, 0x41)) == events{drops(errc::overlong, 257)});
}

TEST_CASE("rtu bus: a line that babbles does not fill the memory nor hide the next request")
{
    events all;
    rtu_bus_framer in = in_step(all);
    time_point now = t0;
    for (int i = 0; i < 2'000; ++i, now += 1ms) {
        in.feed(now, buffer{0x55, 0x03, 0x11});
        take(in, now, all);
    }
    std::size_t dropped = 0;
    for (const bus_event& each : all)
        dropped += each.why == errc::overlong ? each.size : 0;
    CHECK(dropped > 5'000);
    in.feed(now, adu(to_us));
    take(in, now + max_silence, all);
    CHECK(all.back() == to_us);
}

TEST_CASE("rtu bus: before the first silence, a request is believed when silence follows it")
{
    events all;
    rtu_bus_framer in({us}, max_silence);
    CHECK(in.deadline() <= t0);
    take(in, t0, all);
    CHECK(in.deadline() == t0 + max_silence);
    // The port was opened in the middle of a response whose data is a request to us.
    const buffer rest = adu(to_us) + buffer{0x12, 0x34};
    in.feed(t0 + 1ms, rest);
    take(in, t0 + 1ms, all);
    take(in, t0 + 1ms + max_silence, all);
    CHECK(all == events{drops(errc::bad_checksum, rest.size())});

    all.clear();
    rtu_bus_framer opened({us}, max_silence);
    opened.feed(t0, adu(to_us));
    take(opened, t0, all);
    CHECK(all.empty());
    take(opened, t0 + max_silence, all);
    CHECK(all == events{to_us});
}

TEST_CASE("rtu bus: silence is what next() sees")
{
    events all;
    rtu_bus_framer in = in_step(all);
    const buffer whole = adu(to_us);
    in.feed(t0, bytes(whole).first(3));
    take(in, t0, all);
    CHECK(in.deadline() == t0 + max_silence);
    // The process stood still; the rest had been waiting in the driver.
    in.feed(t0 + 5s, bytes(whole).subspan(3));
    take(in, t0 + 5s, all);
    CHECK(all == events{to_us});

    all.clear();
    in.feed(t0 + 6s, bytes(whole).first(3));
    take(in, t0 + 6s, all);
    CHECK_FALSE(in.next(t0 + 6s + max_silence - 1us));
    take(in, t0 + 6s + max_silence, all);
    in.feed(t0 + 7s, bytes(whole).subspan(3));
    take(in, t0 + 8s, all);
    CHECK(all == events{drops(errc::too_short, 3), drops(errc::bad_checksum, 5)});
}

TEST_CASE("rtu bus: an exception with our number is another device's, and is never answered")
{
    check(adus({answers(us, {0x83, 0x02})}), {answers(us, {0x83, 0x02})});
    check(adus({to_us, answers(us, {0xC1, 0x01}), to_us}), {to_us, answers(us, {0xC1, 0x01}), to_us});
}

TEST_CASE("rtu bus: an answer is awaited through silences, for five seconds")
{
    events all;
    rtu_bus_framer in = in_step(all);
    in.feed(t0, adus({asks(neighbour, {0x41, 1})}));
    take(in, t0 + max_silence, all);
    in.feed(t0 + 2s, adus({answers(neighbour, {0x41, 2})}));
    take(in, t0 + 3s, all);
    in.feed(t0 + 10s, adus({asks(neighbour, {0x41, 3})}));
    take(in, t0 + 11s, all);
    in.feed(t0 + 16s, adus({asks(neighbour, {0x41, 4})}));  // nobody waits that long: the next question
    take(in, t0 + 17s, all);
    CHECK(all == events{asks(neighbour, {0x41, 1}), answers(neighbour, {0x41, 2}), asks(neighbour, {0x41, 3}),
                        asks(neighbour, {0x41, 4})});
}

TEST_SUITE_END();
