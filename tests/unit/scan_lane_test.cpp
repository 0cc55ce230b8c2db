// A scan beside the polls of a line, in virtual time: an exchange takes 20 ms, a question that nobody answers 200 ms.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr duration exchange = 20ms;
constexpr duration silence = 200ms;

struct scan_fixture : line_fixture {
    int polls = 0;
    duration scanning{};
    duration probing{};
    bool is_valve_dead = false;
    bool watched = true;

    void poll_every(duration period)
    {
        line.add_route(route_to("D100", table::holding_registers, 0x10, 2), 0, period);
        line.add_route(route_to("M100", table::discrete_inputs, 0, 3), 1, period);
        line.port_opened();
        line.start(now);
    }
    void scan(unsigned highest = 247)
    {
        std::vector<station_number> units;
        for (unsigned unit = 1; unit <= highest; ++unit)
            units.emplace_back(unit);
        line.begin_scan(scan_language::modbus, units, silence, now);
    }
    void run(duration how_long)
    {
        for (const time_point until = now + how_long; now < until;) {
            if (watched)
                line.look_at_scan(now);
            const auto q = line.next(now);
            if (!q) {
                const time_point wake = line.wake_at(now);
                REQUIRE(wake > now);  // else the line would spin
                now = std::min(wake, until);
                continue;
            }
            const bool is_scan = std::holds_alternative<client_line::scan_ticket>(q->origin);
            const bool is_dead = is_scan || (is_valve_dead && number(q->unit) == 6);
            const duration took = is_dead ? silence : exchange;
            const bool is_probe = !is_scan && std::get<schedule::turn>(q->origin).of == lane::probe;
            (is_scan ? scanning : probing) += is_scan || is_probe ? took : duration{};
            polls += is_scan || is_dead ? 0 : 1;
            now += took;
            if (is_dead)
                line.failed(*q, make_error_code(errc::timed_out), now);
            else if (number(q->unit) == 6)
                line.answered(*q, response{bits_read{std::vector<bool>(3)}}, now, noon);
            else
                line.answered(*q, response{registers_read{{1, 2}}}, now, noon);
        }
    }
    void forget() { polls = 0, scanning = probing = {}; }
};

}  // namespace

TEST_CASE("scan lane: on a full line a scan takes 5 %, and the polls keep their pace within that")
{
    scan_fixture f;
    f.poll_every(10ms);  // wants four times the line
    f.run(60s);
    f.forget();
    f.run(200s);
    const int alone = f.polls;
    CHECK(alone == 200s / exchange);

    f.forget();
    f.scan();
    f.run(200s);
    CHECK(f.polls >= 0.948 * alone);
    CHECK(f.scanning <= 200s / 20 + silence);
    CHECK(f.scanning >= 200s / 25);  // it gets on
}

TEST_CASE("scan lane: probes and scan together take 5 %")
{
    scan_fixture f;
    f.is_valve_dead = true;
    f.poll_every(10ms);
    f.run(60s);
    f.scan();
    f.forget();
    f.run(200s);
    CHECK(f.probing > duration{});
    CHECK(f.scanning > duration{});
    CHECK(f.scanning + f.probing <= 200s / 20 + 2 * silence);
}

TEST_CASE("scan lane: an idle line is the scan's, and units of configured stations are not asked")
{
    scan_fixture f;
    f.line.port_opened();
    f.line.start(f.now);
    f.scan();
    f.run(60s);
    const station_scan* const scan = f.line.look_at_scan(f.now);
    REQUIRE(scan != nullptr);
    CHECK(scan->is_over());
    CHECK(scan->units_total() == 245);  // without 5 and 6
    CHECK(f.scanning == 245 * silence);
    CHECK_FALSE(f.line.is_scanning());
}

TEST_CASE("scan lane: between polls it goes where there is time for it")
{
    scan_fixture f;
    f.poll_every(1s);  // 4 % of the line
    f.run(10s);
    f.forget();
    f.scan();
    f.run(30s);
    CHECK(f.polls == 60);          // not one less
    CHECK(f.scanning >= 30s / 3);  // and far more than its share
}

TEST_CASE("scan lane: polls without room between them are delayed within the share only")
{
    scan_fixture f;
    f.poll_every(100ms);  // 40 % of the line, but no gap is as long as a question that nobody answers
    f.run(10s);
    f.forget();
    f.scan();
    f.run(100s);
    CHECK(f.polls >= 2000 * 0.95);
    CHECK(f.scanning <= 100s / 20 + silence);
    CHECK(f.scanning >= 100s / 25);
}

TEST_CASE("scan lane: a scan that nobody looks at ends")
{
    scan_fixture f;
    f.poll_every(500ms);
    f.scan();
    f.watched = false;
    f.run(9s);
    CHECK(f.line.is_scanning());
    f.run(2s);
    CHECK_FALSE(f.line.is_scanning());
    f.forget();
    f.run(20s);
    CHECK(f.scanning == duration{});
    CHECK(f.line.look_at_scan(f.now)->units_asked() > 0);  // what it did is still known
}

TEST_CASE("scan lane: an answer to a scan that was replaced is nobody's")
{
    scan_fixture f;
    f.line.port_opened();
    f.line.start(f.now);
    f.scan();
    const auto q = f.next();
    f.scan(3);
    f.line.answered(q, response{registers_read{{1}}}, f.now += exchange, noon);
    CHECK(f.line.look_at_scan(f.now)->found().empty());
}

TEST_CASE("scan lane: the timeout is the line's until its stations have taught a better one")
{
    scan_fixture f;
    CHECK(f.line.scan_timeout() == 200ms);
    f.line.add_route(f.route_to("D100", table::holding_registers, 0x10, 2), 0, 1s);
    f.line.port_opened();
    f.line.start(f.now);
    const auto q = f.next();
    f.line.answered(q, response{registers_read{{1, 2}}}, f.now += exchange, noon, {}, 60ms);
    CHECK(f.line.scan_timeout() == 120ms);
}
