// An RTU line on which we are server beside others: bytes in, at every cut, and what they are.
#include "tests/unit/framing_bus_bench.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

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

TEST_SUITE_END();
