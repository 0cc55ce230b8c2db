// True multidrop: a client asks 31 chattering neighbours and us, over adapters that glue and split. Not one request to
// us may be missed, and nothing else may be taken for one.
#include "framing_bus_line.hpp"
#include "framing_bus_traffic.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;
using namespace std::chrono_literals;

namespace {

using kind = bus_event::kind;

enum class traffic_kind : std::uint8_t {
    standard,  // functions of the specification
    strange,   // also unknown ones, and requests of wrong length to us: only silence ends these
    noisy,     // also glitches between frames, and neighbours' frames that are damaged
};

struct tally {
    unsigned asked_us = 0;
    unsigned missed = 0;
    unsigned wrong = 0;    // events about us that nobody caused
    unsigned delayed = 0;  // recognised by silence, not with the last byte
    unsigned strangers_wrong = 0;
    unsigned dropped = 0;
};

// To our stations, or to all.
bool is_for_us(const bus_event& e)
{
    const auto& own = bus_traffic::own();
    if (e.what == kind::question && e.content.unit == unit_id::broadcast)
        return parse_request(e.content.pdu).has_value();  // others do nothing
    return e.what == kind::question && std::find(own.begin(), own.end(), e.content.unit) != own.end();
}

class soak {
public:
    soak(unsigned baud_rate, const adapter& through, traffic_kind what, unsigned seed)
        : traffic_(seed), line_({.baud_rate = baud_rate}, through, bus_traffic::own(), traffic_.dice),
          latency_(through.latency), strange_(what != traffic_kind::standard), noisy_(what == traffic_kind::noisy)
    {
    }

    tally run(unsigned exchanges)
    {
        for (unsigned i = 0; i < exchanges; ++i) {
            if (traffic_.happens(20))
                ask_us();
            else if (traffic_.happens(4))
                broadcast();
            else
                ask_neighbour();
            if (line_.events.size() > 400)
                compare();
        }
        line_.pause_until_settled();
        compare();
        return tally_;
    }

private:
    duration random_gap() { return line_.gap() + duration(traffic_.below(traffic_.happens(70) ? 5'000 : 60'000)); }

    void say(const frame& f, kind what)
    {
        expected_.push_back({what, f, {}, f.pdu.size() + rtu_overhead});
        line_.send(encode_rtu(f));
    }

    void glitch()
    {
        if (!noisy_ || !traffic_.happens(10))
            return;
        buffer noise(1 + traffic_.below(traffic_.happens(80) ? 3 : 30));
        for (std::uint8_t& each : noise)
            each = traffic_.happens(60) ? static_cast<std::uint8_t>(traffic_.happens(50) ? 0xFF : 0) : traffic_.byte();
        line_.send(noise);
        if (traffic_.happens(50))
            line_.pause(duration(traffic_.below(3'000)));
    }

    // The receiver alone hears it damaged: the client goes on as usual.
    void say_damaged(const frame& f)
    {
        buffer adu = encode_rtu(f);
        const auto at = static_cast<std::ptrdiff_t>(traffic_.below(static_cast<unsigned>(adu.size())));
        switch (traffic_.below(3)) {
        case 0: adu[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1U << traffic_.below(8)); break;
        case 1: adu.insert(adu.begin() + at, traffic_.byte()); break;
        default: adu.erase(adu.begin() + at); break;
        }
        line_.send(adu);
    }

    void say_to_or_by_neighbour(const frame& f, kind what)
    {
        if (noisy_ && traffic_.happens(10))
            say_damaged(f);
        else
            say(f, what);
    }

    void ask_neighbour()
    {
        const auto e = traffic_.with_neighbour(strange_);
        glitch();
        say_to_or_by_neighbour(e.request, kind::question);
        if (traffic_.happens(5)) {  // does not answer, or only after the client has asked again
            line_.pause(50ms + duration(traffic_.below(200'000)));
            if (traffic_.happens(50))
                return;
            say_to_or_by_neighbour(e.request, kind::question);
            line_.pause(random_gap());
            say_to_or_by_neighbour(e.response, kind::answer);
        }
        line_.pause(random_gap());
        glitch();
        say_to_or_by_neighbour(e.response, kind::answer);
        line_.pause(random_gap());
    }

    void broadcast()
    {
        glitch();
        say(traffic_.broadcast(), kind::question);
        line_.pause(noisy_ ? 100ms : random_gap());
    }

    void ask_us()
    {
        glitch();
        frame request = traffic_.to_us();
        if (strange_ && !noisy_ && traffic_.happens(5))
            request.pdu[0] = 0x55;                       // to be answered with exception 01
        if (strange_ && !noisy_ && traffic_.happens(3))  // to be answered with exception 03
            request.pdu.push_back(encode_rtu(request)[request.pdu.size() + 1] ^ 0x5A);
        ++tally_.asked_us;
        std::size_t seen = line_.events.size();
        say(request, kind::question);
        const time_point asked = line_.now();
        const auto is_it = [&](const bus_event& e) { return e.what == kind::question && e.content == request; };
        for (;;) {
            while (seen < line_.events.size() && !is_it(line_.events[seen]))
                ++seen;
            if (seen < line_.events.size())
                break;
            if (!line_.pause_until_event(seen)) {
                ++tally_.missed;
                return;
            }
        }
        tally_.delayed += line_.event_times[seen] > asked + latency_ ? 1 : 0;
        // Our reply is on the wire; we do not hear ourselves.
        line_.pause(line_.gap() + duration(traffic_.below(20'000)) + random_gap());
    }

    void compare()
    {
        if (noisy_) {
            for (auto* events : {&line_.events, &expected_}) {
                for (const bus_event& e : *events)
                    tally_.dropped += e.what == kind::dropped ? 1 : 0;
                std::erase_if(*events, [](const bus_event& e) { return !is_for_us(e); });
            }
        }
        for (const bus_event& e : line_.events) {
            const auto same = [&](const bus_event& x) { return x.content == e.content && e.what != kind::dropped; };
            const auto found = std::find_if(expected_.begin(), expected_.end(), same);
            if (found != expected_.begin())
                (is_for_us(e) ? tally_.wrong : tally_.strangers_wrong) += 1;
            if (found != expected_.end())
                expected_.erase(expected_.begin(), found + 1);
        }
        // Not yet heard: at most the last exchange.
        line_.events.clear();
        line_.event_times.clear();
    }

    bus_traffic traffic_;
    bus_line line_;
    duration latency_;
    bool strange_;
    bool noisy_;
    std::vector<bus_event> expected_;
    tally tally_;
};

constexpr unsigned soak_exchanges = 4'000;  // of each kind

adapter uart(unsigned baud_rate)
{
    const character_format format{.baud_rate = baud_rate};
    return {"UART", 14, character_time(format, 4), false, frame_gap(format) + character_time(format, 18) + 2ms};
}

adapter usb(unsigned) { return {"USB", 62, 16ms, true, 20ms}; }

}  // namespace

TEST_CASE("rtu bus: among 31 neighbours every request to us is recognised, and nothing else")
{
    unsigned seed = 1;
    for (const auto make : {uart, usb})
        for (const unsigned baud_rate : {9600U, 115200U})
            for (const auto what : {traffic_kind::standard, traffic_kind::strange, traffic_kind::noisy}) {
                const adapter through = make(baud_rate);
                CAPTURE(std::string(through.name));
                CAPTURE(baud_rate);
                CAPTURE(static_cast<int>(what));
                const tally t = soak(baud_rate, through, what, seed++).run(soak_exchanges);
                CHECK(t.asked_us > soak_exchanges / 6);
                CHECK(t.missed == 0);
                CHECK(t.wrong == 0);
                CHECK(t.strangers_wrong == 0);
                if (what == traffic_kind::standard)
                    CHECK(t.delayed == 0);
                if (what == traffic_kind::noisy)
                    CHECK(t.dropped > soak_exchanges / 10);
            }
}

TEST_SUITE_END();
