// A line in virtual time: what its client and its servers put on the wire reaches an rtu_bus_framer through an adapter
// that glues and splits, and the framer is asked when a driver would ask it.
#pragma once

#include "protocols/modbus/rtu.hpp"
#include "protocols/modbus/rtu_bus.hpp"
#include "protocols/serial_timing.hpp"

#include <random>

namespace plcgw::test {

// How a receiver hands over what it got.
struct adapter {
    const char* name;
    std::size_t packet;  // bytes after which it delivers; for a UART at most, at random
    duration latency;    // it delivers this long after a byte at the latest
    bool ticks;          // USB: at multiples of the latency; UART: that long after the last byte
    duration max_silence;
};

class bus_line {
public:
    using random = std::mt19937;

    bus_line(const character_format& format, const adapter& through, std::vector<modbus::unit_id> own, random& dice)
        : framer_(std::move(own), through.max_silence), format_(format), through_(through), dice_(&dice)
    {
        run(now_ + std::chrono::seconds(1));
        events.clear();
    }

    std::vector<modbus::bus_event> events;  // all that came out
    std::vector<time_point> event_times;

    time_point now() const { return now_; }
    duration gap() const { return frame_gap(format_); }

    // Somebody sends, beginning now; ends with the last byte on the wire.
    void send(bytes what)
    {
        const time_point start = now_;
        for (std::size_t i = 0; i < what.size(); ++i)
            on_wire_.emplace_back(start + character_time(format_, i + 1), what[i]);
        run(start + character_time(format_, what.size()));
    }

    void pause(duration for_how_long) { run(now_ + for_how_long); }

    // Silence until the framer has said all it can say.
    void pause_until_settled() { pause(2 * through_.latency + 2 * through_.max_silence); }

    // Silence until the framer says something more; nothing if it does not.
    std::optional<duration> pause_until_event(std::size_t events_before)
    {
        const time_point start = now_;
        const time_point end = now_ + 2 * (through_.latency + through_.max_silence);
        while (events.size() <= events_before && now_ < end)
            run(now_ + std::chrono::microseconds(200));
        return events.size() > events_before ? std::optional(event_times[events_before] - start) : std::nullopt;
    }

private:
    void run(time_point until)
    {
        while (const auto due = next_delivery(until)) {
            ask_until(*due);
            buffer chunk;
            while (!on_wire_.empty() && on_wire_.front().first <= *due && chunk.size() < through_.packet) {
                chunk.push_back(on_wire_.front().second);
                on_wire_.pop_front();
            }
            framer_.feed(*due, chunk);
            take_events(*due);
            draw_packet();
        }
        ask_until(until);
        now_ = until;
    }

    // When the adapter hands over what came first, if that is certain before `until`.
    std::optional<time_point> next_delivery(time_point until)
    {
        if (on_wire_.empty())
            return std::nullopt;
        time_point due;
        if (through_.ticks) {
            const auto tick = through_.latency.count();
            due = time_point(duration((on_wire_.front().first.time_since_epoch().count() / tick + 1) * tick));
        }
        else {
            std::size_t last = 0;
            while (last + 1 < on_wire_.size() && last + 1 < packet_ &&
                   on_wire_[last + 1].first <= on_wire_[last].first + through_.latency)
                ++last;
            due = on_wire_[last].first + (last + 1 == packet_ ? duration{} : through_.latency);
        }
        if (on_wire_.size() >= packet_)
            due = std::min(due, on_wire_[packet_ - 1].first);
        return due <= until ? std::optional(due) : std::nullopt;
    }

    void draw_packet() { packet_ = through_.ticks ? through_.packet : 1 + (*dice_)() % through_.packet; }

    // A driver that reads until the deadline and then asks.
    void ask_until(time_point end)
    {
        while (framer_.deadline() <= end) {
            asked_ = std::max(asked_, framer_.deadline());
            take_events(asked_);
        }
    }

    void take_events(time_point at)
    {
        while (auto event = framer_.next(at)) {
            events.push_back(std::move(*event));
            event_times.push_back(at);
        }
    }

    modbus::rtu_bus_framer framer_;
    character_format format_;
    adapter through_;
    random* dice_;
    std::deque<std::pair<time_point, std::uint8_t>> on_wire_;
    std::size_t packet_ = 1;
    time_point now_{std::chrono::hours(1)};
    time_point asked_{std::chrono::hours(1)};
};

}  // namespace plcgw::test
