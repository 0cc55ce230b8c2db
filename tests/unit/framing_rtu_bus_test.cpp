// An RTU line on which we are server beside others: bytes in, at every cut, and what they are.
#include "protocols/modbus/crc.hpp"
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

static_assert(framer<rtu_bus_framer>);

constexpr duration max_silence = 20ms;
const unit_id us{1};
const unit_id us_too{0x11};
const unit_id neighbour{5};
const unit_id other{6};

using events = std::vector<bus_event>;

bus_event asks(unit_id unit, buffer pdu)
{
    const std::size_t size = pdu.size() + rtu_overhead;
    return {bus_event::kind::question, {unit, std::move(pdu)}, {}, size};
}

bus_event answers(unit_id unit, buffer pdu)
{
    bus_event e = asks(unit, std::move(pdu));
    e.what = bus_event::kind::answer;
    return e;
}

bus_event drops(errc why, std::size_t size) { return {bus_event::kind::dropped, {}, why, size}; }

buffer operator+(buffer a, const buffer& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

buffer adu(const bus_event& e) { return encode_rtu(e.content); }

buffer adus(const events& all)
{
    buffer result;
    for (const bus_event& each : all)
        result = std::move(result) + adu(each);
    return result;
}

void take(rtu_bus_framer& in, time_point now, events& to)
{
    while (auto each = in.next(now))
        to.push_back(std::move(*each));
}

// One that has heard silence: the next byte begins a frame.
rtu_bus_framer in_step(events& nothing)
{
    rtu_bus_framer in({us, us_too}, max_silence);
    take(in, t0 - 1s, nothing);
    take(in, t0 - 1s + max_silence, nothing);
    return in;
}

// Pieces a millisecond apart, as if there were no silence between frames; and silence behind all.
events receive(const pieces& received)
{
    events all;
    rtu_bus_framer in = in_step(all);
    time_point now = t0;
    for (const bytes piece : received) {
        in.feed(now, piece);
        take(in, now, all);
        now += 1ms;
    }
    take(in, now + max_silence, all);
    CHECK(in.deadline() == time_point::max());
    return all;
}

events receive(bytes received) { return receive(pieces{received}); }

// Byte for byte the same events, however they are cut.
void check(const buffer& received, const events& expected)
{
    every_cut(received, [&](const pieces& cut) { CHECK(receive(cut) == expected); });
}

const bus_event to_us = asks(us, {0x03, 0x00, 0x10, 0x00, 0x02});
const bus_event to_neighbour = asks(neighbour, {0x03, 0x00, 0x6B, 0x00, 0x08});
const bus_event from_neighbour =
    answers(neighbour, {0x03, 0x10, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});

// Eight registers that hold a whole request to us, bytes `at` and on.
bus_event holding_a_request(std::size_t at, const bus_event& held = to_us)
{
    bus_event e = from_neighbour;
    const buffer inner = adu(held);
    std::copy(inner.begin(), inner.end(), e.content.pdu.begin() + 2 + static_cast<std::ptrdiff_t>(at));
    return e;
}

}  // namespace

TEST_CASE("rtu bus: conversations without any silence in them")
{
    const bus_event sets = asks(neighbour, {0x06, 0x00, 0x01, 0x00, 0x03});
    const bus_event was_set = answers(neighbour, {0x06, 0x00, 0x01, 0x00, 0x03});
    const bus_event loop = asks(other, {0x08, 0x00, 0x00, 0xA5, 0x37});
    const bus_event looped = answers(other, {0x08, 0x00, 0x00, 0xA5, 0x37});
    const bus_event to_all = asks(unit_id::broadcast, {0x06, 0x00, 0x01, 0x00, 0x03});
    const struct {
        const char* name;
        events talk;
    } rows[] = {
        {"a request to us", {to_us}},
        {"two of our stations", {to_us, asks(us_too, {0x01, 0x00, 0x00, 0x00, 0x08})}},
        {"the same question again", {to_us, to_us}},
        {"a neighbour, then us", {to_neighbour, from_neighbour, to_us}},
        {"a neighbour is refused", {to_neighbour, answers(neighbour, {0x83, 0x02}), to_us}},
        {"a neighbour does not answer", {to_neighbour, to_us}},
        {"a neighbour does not answer, another does", {to_neighbour, loop, looped, to_us}},
        {"a neighbour answers when asked again", {to_neighbour, to_neighbour, from_neighbour, to_us}},
        {"a neighbour answers twice", {to_neighbour, to_neighbour, from_neighbour, from_neighbour, to_us}},
        {"answers that repeat the question", {sets, was_set, loop, looped, sets, was_set, to_us}},
        {"a broadcast", {to_all, to_neighbour, from_neighbour, to_all, to_us}},
        {"a response nobody asked for", {from_neighbour, to_us}},
        {"an event log and a server id",
         {asks(neighbour, {0x0C}), answers(neighbour, {0x0C, 8, 0, 0, 1, 8, 1, 33, 32, 0}), asks(other, {0x11}),
          answers(other, {0x11, 0x02, 0xF3, 0xFF}), to_us}},
        {"a long loop back", {to_neighbour, from_neighbour, asks(us, {0x08, 0x00, 0x00, 1, 2, 3, 4})}},
        {"a function that nobody knows, to us", {to_neighbour, from_neighbour, asks(us, {0x41, 0x00})}},
        {"such functions between neighbours", {asks(other, {0x41, 1, 2}), answers(other, {0x41, 3, 4, 5}), to_us}},
        {"and others behind them",
         {asks(other, {0x41, 1, 2}), answers(other, {0x41, 3}), to_neighbour, from_neighbour}},
        {"a count that contradicts the length, to us", {asks(us, {0x10, 0, 0, 0, 1, 2, 0, 1, 0x77})}},
        {"high register numbers", {asks(neighbour, {0x03, 0x9C, 0x40, 0x00, 0x08}), from_neighbour, to_us}},
        {"the same without an answer", {asks(neighbour, {0x03, 0x9C, 0x40, 0x00, 0x08}), to_us}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        check(adus(row.talk), row.talk);
    }
}

TEST_CASE("rtu bus: in step, a request to us is recognised with its last byte")
{
    const events talks[] = {
        {to_us},
        {asks(us_too, {0x10, 0x00, 0x01, 0x00, 0x01, 0x02, 0x12, 0x34})},
        {asks(us, {0x11})},
        {to_neighbour, from_neighbour, to_us},
        {to_neighbour, to_us},
    };
    for (const events& talk : talks) {
        events all;
        rtu_bus_framer in = in_step(all);
        const buffer received = adus(talk);
        in.feed(t0, bytes(received).first(received.size() - 1));
        take(in, t0, all);
        CHECK((all.empty() || all.back() != talk.back()));
        in.feed(t0, bytes(received).last(1));
        take(in, t0, all);
        CHECK(all == talk);
        CHECK(in.deadline() == time_point::max());
        CHECK(in.heard() == t0);
    }
}

TEST_CASE("rtu bus: what a neighbour's data holds is not said to us")
{
    const bus_event writes = asks(neighbour, {0x10, 0, 0, 0, 8, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const bus_event to_all = asks(unit_id::broadcast, {0x05, 0x00, 0x01, 0xFF, 0x00});
    for (const bus_event& held : {to_us, to_all})
        for (std::size_t at = 0; at <= 8; ++at) {
            const bus_event response = holding_a_request(at, held);
            check(adus({to_neighbour, response, to_us}), {to_neighbour, response, to_us});
            check(adus({response}), {response});  // also when the question was missed

            bus_event request = writes;
            const buffer inner = adu(held);
            std::copy(inner.begin(), inner.end(), request.content.pdu.begin() + 6 + static_cast<std::ptrdiff_t>(at));
            const bus_event done = answers(neighbour, {0x10, 0, 0, 0, 8});
            check(adus({request, done, to_us}), {request, done, to_us});
        }
}

TEST_CASE("rtu bus: nor when that frame is damaged, or one byte short or long")
{
    for (std::size_t at = 0; at <= 8; ++at) {
        const buffer before = adu(to_neighbour);
        const buffer response = adu(holding_a_request(at));
        const auto is_to_us = [&](const bus_event& e) { return e == to_us; };
        const auto check_damaged = [&](const buffer& damaged) {
            const events alone = receive(before + damaged);
            CHECK(std::none_of(alone.begin(), alone.end(), is_to_us));
            const events followed = receive(before + damaged + adu(to_us));
            CHECK(followed.back() == to_us);
            CHECK(std::count_if(followed.begin(), followed.end(), is_to_us) == 1);
        };
        for (std::size_t bit = 0; bit < 8 * response.size(); ++bit) {
            const std::size_t byte = bit / 8;
            if (byte >= 3 + at && byte < 3 + at + 8)
                continue;  // the request itself is damaged
            buffer flipped = response;
            flipped[byte] = static_cast<std::uint8_t>(flipped[byte] ^ 1U << (bit % 8));
            check_damaged(flipped);
        }
        for (std::size_t byte = 0; byte < response.size(); ++byte) {
            if (byte >= 3 + at && byte < 3 + at + 8)
                continue;
            buffer changed = response;
            changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(byte));
            if (at < 8 || byte < 3 + at)  // else it is cut off just behind the request: see rtu_bus.hpp
                check_damaged(changed);
            changed = response;
            changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(byte), 0x5A);
            check_damaged(changed);
        }
    }
}

TEST_CASE("rtu bus: a response that begins like a request, and a request that begins like a response")
{
    // 05 03 10 00 00 01 and its CRC are a whole request; as a response they are the first 8 of 21 bytes.
    bus_event response = from_neighbour;
    const buffer looks = encode_rtu({neighbour, {0x03, 0x10, 0x00, 0x00, 0x01}});
    std::copy(looks.begin() + 1, looks.end(), response.content.pdu.begin());
    check(adus({to_neighbour, response, to_us}), {to_neighbour, response, to_us});
    check(adus({response, to_us}), {response, to_us});

    // The other way round: a write whose byte count and first data byte are the CRC of what stands before them.
    for (unsigned first = 0; first < 0x10000; ++first) {
        buffer pdu{0x10, static_cast<std::uint8_t>(first >> 8), static_cast<std::uint8_t>(first & 0xFF), 0, 8};
        const buffer as_response = encode_rtu({neighbour, pdu});
        if (as_response[6] != 16)
            continue;
        pdu.insert(pdu.end(), {16, as_response[7], 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14});
        const bus_event write = asks(neighbour, pdu);
        const bus_event done = answers(neighbour, {pdu.begin(), pdu.begin() + 5});
        check(adus({write, done, to_us}), {write, done, to_us});
        check(adus({write, to_us}), {write, to_us});
        break;
    }
}

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
