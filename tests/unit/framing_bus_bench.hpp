// A framer of an RTU line with neighbours, fed with frames without silence between them.
#pragma once

#include "protocols/modbus/rtu.hpp"
#include "protocols/modbus/rtu_bus.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

namespace plcgw::test {

using namespace modbus;

static_assert(framer<rtu_bus_framer>);

inline constexpr duration max_silence = 20ms;
inline const unit_id us{1};
inline const unit_id us_too{0x11};
inline const unit_id neighbour{5};
inline const unit_id other{6};

using events = std::vector<bus_event>;

inline bus_event asks(unit_id unit, buffer pdu)
{
    const std::size_t size = pdu.size() + rtu_overhead;
    return {bus_event::kind::question, {unit, std::move(pdu)}, {}, size};
}

inline bus_event answers(unit_id unit, buffer pdu)
{
    bus_event e = asks(unit, std::move(pdu));
    e.what = bus_event::kind::answer;
    return e;
}

inline bus_event drops(errc why, std::size_t size) { return {bus_event::kind::dropped, {}, why, size}; }

inline buffer operator+(buffer a, const buffer& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

inline buffer adu(const bus_event& e) { return encode_rtu(e.content); }

inline buffer adus(const events& all)
{
    buffer result;
    for (const bus_event& each : all)
        result = std::move(result) + adu(each);
    return result;
}

inline void take(rtu_bus_framer& in, time_point now, events& to)
{
    while (auto each = in.next(now))
        to.push_back(std::move(*each));
}

// One that has heard silence: the next byte begins a frame.
inline rtu_bus_framer in_step(events& nothing)
{
    rtu_bus_framer in({us, us_too}, max_silence);
    take(in, t0 - 1s, nothing);
    take(in, t0 - 1s + max_silence, nothing);
    return in;
}

// Pieces a millisecond apart, as if there were no silence between frames; and silence behind all.
inline events receive(const pieces& received)
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

inline events receive(bytes received) { return receive(pieces{received}); }

// Byte for byte the same events, however they are cut.
inline void check(const buffer& received, const events& expected)
{
    every_cut(received, [&](const pieces& cut) { CHECK(receive(cut) == expected); });
}

inline const bus_event to_us = asks(us, {0x03, 0x00, 0x10, 0x00, 0x02});
inline const bus_event to_neighbour = asks(neighbour, {0x03, 0x00, 0x6B, 0x00, 0x08});
inline const bus_event from_neighbour =
    answers(neighbour, {0x03, 0x10, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});

// Eight registers that hold a whole request to us, bytes `at` and on.
inline bus_event holding_a_request(std::size_t at, const bus_event& held = to_us)
{
    bus_event e = from_neighbour;
    const buffer inner = adu(held);
    std::copy(inner.begin(), inner.end(), e.content.pdu.begin() + 2 + static_cast<std::ptrdiff_t>(at));
    return e;
}

}  // namespace plcgw::test
