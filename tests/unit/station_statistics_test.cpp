// What a line counts of its stations, and the state that follows.
#include "bridge/port_meter.hpp"
#include "bridge/routes/station_statistics.hpp"
#include "protocols/errc.hpp"
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

// The next question to the pump; the valve answers meanwhile.
client_line::question next_of_pump(line_fixture& f)
{
    for (;;) {
        const auto q = f.next();
        if (q.unit == unit_id{5})
            return q;
        f.answer(q, bits_read{{true, true, true}});
    }
}

response answer_to(const client_line::question& q)
{
    const auto* const read = std::get_if<read_table>(&q.request());
    return registers_read{std::vector<std::uint16_t>(read->count, 7)};
}

void attempt(line_fixture& f, const client_line::question& q, errc why) { f.line.attempt_failed(q, {why, {}}); }

}  // namespace

TEST_CASE("station statistics: from start to up, degraded, down and up again")
{
    line_fixture f;
    f.add_reads();
    CHECK(f.line.stations_total() == 2);
    CHECK(f.line.device_of(0).state == link_state::unknown);
    f.line.port_lost("port absent");
    CHECK(f.line.device_of(0).state == link_state::down);
    CHECK(f.line.device_of(0).detail == "port absent");
    f.line.port_opened();
    CHECK(f.line.take_device_changes());
    CHECK(f.line.device_of(0).state == link_state::starting);
    CHECK_FALSE(f.line.take_device_changes());

    auto q = next_of_pump(f);
    f.answer(q, answer_to(q), noon);
    CHECK(f.line.take_device_changes());
    device_status pump = f.line.device_of(0);
    CHECK(pump.state == link_state::up);
    CHECK(pump.device == "pump");
    CHECK(pump.port == "bus 1");
    CHECK(pump.last_ok == noon);
    CHECK(pump.requests == 1);
    CHECK(pump.detail.empty());

    q = next_of_pump(f);
    attempt(f, q, errc::timed_out);
    attempt(f, q, errc::bad_checksum);
    f.fail(q, errc::bad_checksum);
    pump = f.line.device_of(0);
    CHECK(pump.state == link_state::degraded);
    CHECK(pump.requests == 3);
    CHECK(pump.timeouts == 1);
    CHECK(pump.last_ok == noon);
    CHECK(pump.detail.find("last request was not answered") != std::string::npos);

    q = next_of_pump(f);
    attempt(f, q, errc::timed_out);
    f.fail(q);
    pump = f.line.device_of(0);
    CHECK(pump.state == link_state::down);
    CHECK(pump.timeouts == 2);
    CHECK(pump.detail.find("does not answer") != std::string::npos);
    CHECK(f.line.device_of(1).state == link_state::up);

    q = next_of_pump(f);
    f.answer(q, answer_to(q), wall_time{9});
    CHECK(f.line.device_of(0).state == link_state::up);
    CHECK(f.line.device_of(0).last_ok == wall_time{9});
}

TEST_CASE("station statistics: an exception is an answer, but no good one")
{
    line_fixture f;
    f.add_reads();
    f.line.port_opened();
    const auto q = next_of_pump(f);
    f.answer(q, exception_code::illegal_data_address, noon);
    const device_status pump = f.line.device_of(0);
    CHECK(pump.state == link_state::up);
    CHECK(pump.exceptions == 1);
    CHECK(pump.requests == 1);
    CHECK(pump.timeouts == 0);
    CHECK(pump.last_ok == wall_time::never);
    CHECK(pump.detail.find("02") != std::string::npos);
}

TEST_CASE("station statistics: a question that did not go out says nothing of the station")
{
    line_fixture f;
    f.add_reads();
    f.line.port_opened();
    f.fail(next_of_pump(f), errc::line_not_quiet);
    CHECK(f.line.device_of(0).state == link_state::starting);
    CHECK(f.line.device_of(0).requests == 0);
}

TEST_CASE("station statistics: a port that comes back proves nothing until somebody answers")
{
    line_fixture f;
    f.add_reads();
    f.line.port_opened();
    auto q = next_of_pump(f);
    f.answer(q, answer_to(q));
    f.line.port_lost("port absent");
    CHECK(f.line.device_of(0).state == link_state::down);
    f.line.port_opened();
    CHECK(f.line.device_of(0).state == link_state::starting);
    q = next_of_pump(f);
    f.answer(q, answer_to(q));
    CHECK(f.line.device_of(0).state == link_state::up);
}

TEST_CASE(
    "station statistics: the poll cycle is that of the most frequent read, smoothed; the response time is measured")
{
    station_statistics of(1);
    of.add_read(0, 3, 1s);
    of.add_read(0, 4, 100ms);
    of.add_read(0, 5, 500ms);
    time_point now = t0;
    for (int i = 0; i < 100; ++i) {
        of.was_read(0, 4, now += 120ms);
        of.was_read(0, 3, now + 1ms);
    }
    CHECK(of.status_of(0).cycle_us == 120'000);
    of.was_read(0, 4, now += 920ms);
    CHECK(of.status_of(0).cycle_us == 220'000);
    of.answered(7, nullptr, noon);  // nobody configured that one
    CHECK(of.size() == 1);

    line_fixture f;
    f.add_reads();
    f.line.port_opened();
    const auto q = next_of_pump(f);
    f.line.answered(q, answer_to(q), f.now += 30ms, noon, {}, 12ms);
    CHECK(f.line.device_of(0).rtt_us == 12'000);
}

TEST_CASE("port meter: state and since, reopens, the last error")
{
    port_meter meter("bus 1");
    CHECK(meter.status().port == "bus 1");
    CHECK(meter.status().state == link_state::starting);
    CHECK(meter.status().since == wall_time::never);

    meter.lost(wall_time{5}, "no such device");
    meter.lost(wall_time{6}, "no such device");
    CHECK(meter.status().state == link_state::down);
    CHECK(meter.status().since == wall_time{5});
    CHECK(meter.status().reopens == 0);
    meter.opened(wall_time{7});
    CHECK(meter.status().state == link_state::up);
    CHECK(meter.status().since == wall_time{7});
    CHECK(meter.status().reopens == 0);
    CHECK(meter.status().detail == "no such device");

    meter.sent(8);
    meter.frames_sent();
    meter.received(7);
    meter.frames_received();
    meter.fault(errc::bad_checksum);
    meter.fault(errc::bad_checksum);
    CHECK(meter.status().detail == make_error_code(errc::bad_checksum).message());
    meter.lost(wall_time{8}, "unplugged");
    meter.opened(wall_time{9});
    meter.fault(errc::bad_checksum);
    const port_status& s = meter.status();
    CHECK(s.detail == make_error_code(errc::bad_checksum).message());
    CHECK(s.reopens == 1);
    CHECK(s.tx_bytes == 8);
    CHECK(s.tx_frames == 1);
    CHECK(s.rx_bytes == 7);
    CHECK(s.rx_frames == 1);
    CHECK(s.errors == 3);
}
