// One emulated serial wire: who sends when, what is late, and what breaks the rule of silence. Pure arithmetic: the
// time is a parameter, so a test needs no waiting.
#pragma once

#include "tests/bench/measured.hpp"
#include "tests/bench/stations.hpp"
#include "tests/bench/wire_format.hpp"

namespace plcgw::bench {

class wire {
public:
    wire(wire_format format, station_table stations) : format_(format), stations_(std::move(stations)) {}

    // The client's driver took these bytes: they occupy the wire from now on, or behind the ones before them.
    void heard(nanoseconds now, byte_span bytes);

    // When due() has something to do; never() = when bytes were heard.
    nanoseconds deadline() const;
    static constexpr nanoseconds never() { return INT64_MAX; }

    // What the client's driver hands over by now. Call it until nothing comes.
    byte_vector due(nanoseconds now);

    const wire_format& format() const { return format_; }
    measured& window() { return window_; }

private:
    struct response_on_wire {
        nanoseconds start = 0;
        byte_vector bytes;
        std::size_t handed_over = 0;
        nanoseconds ideal = 0;  // of the whole transaction, with the silence before it
        std::uint8_t unit = 0;
        std::uint8_t function = 0;
        unsigned first = 0;
    };

    void begin_request(nanoseconds start);
    void end_request(nanoseconds end);
    void finish_response();
    std::size_t next_chunk() const;  // bytes of the response that the driver will have handed over with the next chunk
    nanoseconds handed_over_at(std::size_t count) const;
    nanoseconds response_end() const;

    wire_format format_;
    station_table stations_;
    measured window_;
    // the client's transmitter
    nanoseconds burst_start_ = 0;
    std::int64_t burst_size_ = 0;
    nanoseconds sent_until_ = 0;
    byte_vector request_;  // begun
    // the wire
    nanoseconds busy_until_ = 0;  // end of the last byte of anybody; 0 = nothing was on it yet
    bool answered_last_ = false;
    std::optional<response_on_wire> response_;
};

}  // namespace plcgw::bench
