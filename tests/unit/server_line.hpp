// A station on its line, as the daemon's driver joins them: bytes in, replies out, and what the station noted.
#pragma once

#include "protocols/modbus/bus_framer.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/virtual_time.hpp"
#include "tests/unit/station_bench.hpp"

namespace plcgw::test {

// What frames left behind.
struct aftermath {
    std::vector<buffer> replies;  // PDUs
    std::vector<std::uint16_t> counters;
    buffer log;
    std::uint16_t error{};  // D8402
    bool acted = false;     // a device changed that shows no error
    bool operator==(const aftermath&) const = default;
};

class server_line {
public:
    static constexpr modbus::unit_id us{1};
    static constexpr duration longest_silence = 2 * modbus::ascii_max_silence;

    explicit server_line(modbus::framing mode) : in_(mode, {us}, 20ms)
    {
        take();
        be_silent();
    }

    // As after power-on, but without the time that it takes.
    void begin_anew()
    {
        undo();
        if (bench_.station.listen_only())
            bench_.ask(restart);
        bench_.ask({0x08, 0x00, 0x03, modbus::ascii_delimiter, 0x00});
        bench_.ask(restart_and_clear_log);
        bench_.station.sent();
        bench_.set("D8402", 0);
        replies_.clear();
        bench_.plc.memory().take_changes();
    }

    void hear(bytes piece)
    {
        in_.feed(now_, piece);
        take();
    }

    void be_silent()
    {
        now_ += longest_silence;
        take();
    }

    // Pieces a millisecond apart, silence behind them.
    aftermath hear_all(const pieces& received)
    {
        begin_anew();
        for (const bytes piece : received) {
            hear(piece);
            now_ += 1ms;
        }
        be_silent();
        return so_far();
    }

    aftermath hear_all(bytes received) { return hear_all(pieces{received}); }

    // The same requests without a line.
    aftermath executed(const buffer& pdu, unsigned times)
    {
        begin_anew();
        for (unsigned i = 0; i < times; ++i)
            if (auto reply = bench_.ask(pdu))
                replies_.push_back(std::move(*reply));
        return so_far();
    }

    aftermath so_far() { return {replies_, bench_.counters(), bench_.log(), bench_.word("D8402"), has_acted()}; }

private:
    void take()
    {
        for (;;) {
            in_.set_delimiters({bench_.station.delimiter()});
            const auto event = in_.next(now_);
            if (!event)
                return;
            take(*event);
        }
    }

    void take(const modbus::bus_event& event)
    {
        if (event.what == modbus::bus_event::kind::dropped)
            return bench_.station.bus_error(event.why);
        bench_.station.bus_message();
        if (event.what != modbus::bus_event::kind::question)
            return;
        if (auto reply = bench_.station.answer(event.content)) {
            bench_.station.sent();
            replies_.push_back(std::move(*reply));
        }
    }

    bool has_acted()
    {
        for (const plc::change& each : bench_.plc.memory().take_changes()) {
            const auto shows = [&](const char* device, std::size_t size) {
                return plc::overlaps(each, bench_.at(device), size);
            };
            if (!(shows("D8402", 32) || shows("D8063", 16) || shows("M8402", 2) || shows("M8063", 1)))
                changed_.push_back(each);
        }
        return !changed_.empty();
    }

    // Else a request that comes again would change nothing.
    void undo()
    {
        has_acted();
        for (const plc::change& each : std::exchange(changed_, {}))
            for (std::size_t bit = each.first_bit; bit < each.first_bit + each.count; ++bit)
                bench_.plc.memory().set_bit({each.area, bit}, false);
    }

    station_bench bench_;
    modbus::bus_framer in_;
    time_point now_ = t0;
    std::vector<buffer> replies_;
    std::vector<plc::change> changed_;
};

}  // namespace plcgw::test
