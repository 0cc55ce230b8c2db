// A line with two stations, played in virtual time.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "tests/support/plc_fixture.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <map>

namespace plcgw::test {

inline constexpr wall_time noon{1'700'000'000'000'000'000};

inline constexpr modbus::serial_options patient{.format = {}, .retries = 2};
inline constexpr modbus::serial_options hasty{.format = {}, .response_timeout = 200ms};

struct line_fixture : fx3u_fixture {
    client_line line{"bus 1",
                     {{"pump", modbus::unit_id{5}, patient}, {"valve", modbus::unit_id{6}, hasty}},
                     {.longest_silence = 10s}};
    time_point now = t0;

    // Two reads of the pump, one of the valve.
    void add_reads()
    {
        line.add_route(route_to("D100", modbus::table::holding_registers, 0x10, 2), 0, 3s);
        line.add_route(route_to("M100", modbus::table::discrete_inputs, 0, 3), 1, 3s);
        line.add_route(route_to("D200", modbus::table::input_registers, 0, 1), 0, 3s);
        line.start(t0);
    }

    client_line::question next()
    {
        auto q = line.next(now);
        for (int i = 0; !q && i < 100; ++i)
            q = line.next(now = line.wake_at(now));
        REQUIRE(q.has_value());
        return *q;
    }
    void answer(const client_line::question& q, const modbus::response& with, wall_time wall = noon)
    {
        now += 20ms;
        line.answered(q, with, now, wall);
    }
    void fail(const client_line::question& q, errc why = errc::timed_out)
    {
        now += 500ms;
        line.failed(q, why, now);
    }
    // Drains the memory as the gateway does. True when a route wants to write.
    bool memory_changed()
    {
        bool due = false;
        for (const plc::change& each : plc.memory().take_changes())
            due = line.memory_changed(plc, each) || due;
        return due;
    }
    const sample& said(const char* route)  // last
    {
        for (const sample& each : line.take_samples(now))
            last[each.route] = each;
        return last[route];
    }
    std::map<std::string, sample> last{};
};

}  // namespace plcgw::test
