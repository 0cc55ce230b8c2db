// One emulated RS-485 pair that several members share: what one says all others hear, the stations, too. Whoever speaks
// while another does, damages both. Pure arithmetic: the time is a parameter, so a test needs no waiting.
#pragma once

#include "tests/bench/stations.hpp"
#include "tests/bench/wire_format.hpp"

#include <deque>

namespace plcgw::bench {

class party_line {
public:
    static constexpr int stations = -1;  // as a talker; members are counted from 0

    struct event {
        enum class kind : std::uint8_t {
            request,    // whole, of a member
            collision,  // began at that time
            write,      // executed by a station: one for each register
        } what{};
        nanoseconds at = 0;  // when its first byte began on the wire; of a write, when the request ended
        int talker = 0;
        int other = 0;  // whom a collision hit
        unsigned unit = 0;
        unsigned function = 0;
        unsigned first = 0;  // register
        unsigned value = 0;  // of a request how many, or a single register's value
        bool damaged = false;
        nanoseconds silence = 0;  // before a request, since the last byte of anybody
    };
    struct received {
        std::size_t by;  // member
        std::uint8_t byte;
    };

    party_line(wire_format format, station_table on_it, std::size_t members)
        : format_(format), stations_(std::move(on_it)), members_(members)
    {
    }

    // A member's driver took these bytes: they occupy the wire from now on, or behind the ones before them.
    void heard(nanoseconds now, std::size_t member, byte_span bytes);

    // A cable that is pulled carries nothing in either direction. What was under way is lost.
    void cut(std::size_t member, bool is_cut) { members_[member].is_cut = is_cut; }

    nanoseconds deadline() const;  // never(): nothing is on the wire
    static constexpr nanoseconds never() { return INT64_MAX; }
    std::vector<received> due(nanoseconds now);  // bytes whose stop bit has ended

    std::vector<event> take_events();
    const wire_format& format() const { return format_; }

private:
    struct on_wire {
        nanoseconds start = 0;
        nanoseconds end = 0;
        int talker = 0;
        std::uint8_t byte = 0;
        bool hit = false;
    };
    struct member_state {
        bool is_cut = false;
        nanoseconds sent_until = 0;
        byte_vector request;  // begun
        nanoseconds begun = 0;
        nanoseconds last = 0;
        nanoseconds silence = 0;
        bool damaged = false;
    };

    void say(int talker, nanoseconds& sent_until, nanoseconds from, byte_span bytes);
    void note_hits(on_wire& added);
    void assemble(member_state& of, const on_wire& byte);
    void end_request(member_state& of, const on_wire& last);

    wire_format format_;
    station_table stations_;
    std::vector<member_state> members_;
    nanoseconds stations_sent_until_ = 0;
    std::deque<on_wire> air_;     // by their ends
    nanoseconds busy_until_ = 0;  // the last byte that ended
    nanoseconds collision_until_ = 0;
    std::vector<event> events_;
};

}  // namespace plcgw::bench
