// Write-through routes: a client waits until the station has taken what it wrote into the PLC.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

using numbers = std::vector<std::uint64_t>;

struct through_fixture : line_fixture {
    through_fixture()
    {
        line.add_route(route_to("D100", table::holding_registers, 0, 2, direction::write_through), 0, 1s);
        line.port_opened();
        line.start(t0);
    }
    // As the server of a client does it.
    numbers client_writes(std::uint16_t first, std::uint16_t second)
    {
        set("D100", first);
        set("D101", second);
        numbers waiting = line.write_through(plc);
        memory_changed();
        return waiting;
    }
    void device_has(std::uint16_t first, std::uint16_t second)
    {
        client_writes(first, second);
        answer(next(), written{});
        line.take_through();
        memory_changed();
    }
    // number, exception code or 0
    std::vector<std::pair<std::uint64_t, unsigned>> outcomes()
    {
        std::vector<std::pair<std::uint64_t, unsigned>> all;
        for (const auto& each : line.take_through())
            all.emplace_back(each.number, each.failed ? static_cast<unsigned>(*each.failed) : 0U);
        return all;
    }
    bool is_quiet() { return !line.next(now += 1min).has_value(); }
};

using outcome_list = std::vector<std::pair<std::uint64_t, unsigned>>;

}  // namespace

TEST_CASE("write-through: the outcome is known when the station has answered")
{
    through_fixture f;
    CHECK(f.client_writes(1, 2) == numbers{1});
    CHECK(f.outcomes().empty());
    const auto q = f.next();
    CHECK(f.outcomes().empty());
    CHECK(std::get<write_multiple_registers>(q.request()).values == std::vector<std::uint16_t>{1, 2});
    f.answer(q, written{});
    CHECK(f.outcomes() == outcome_list{{1, 0}});
    CHECK(f.is_quiet());
    CHECK(f.word("D100") == 1);
}

TEST_CASE("write-through: a value that stays the same goes to the station all the same")
{
    through_fixture f;
    f.device_has(1, 2);
    CHECK(f.client_writes(1, 2).size() == 1);
    f.answer(f.next(), written{});
    CHECK(f.outcomes().size() == 1);
}

TEST_CASE("write-through: what is written elsewhere waits for nobody")
{
    through_fixture f;
    f.set("D102", 5);
    CHECK(f.line.write_through(f.plc).empty());
    f.set("D100", 5);  // by a route or a PLC's program
    f.line.memory_written();
    f.memory_changed();
    f.set("D103", 5);
    CHECK(f.line.write_through(f.plc).empty());
    f.answer(f.next(), written{});  // it is written as by any other route
    CHECK(f.outcomes().empty());
}

TEST_CASE("write-through: what the station refuses is told, taken back, and not repeated")
{
    through_fixture f;
    f.device_has(1, 2);
    f.client_writes(7, 8);
    f.answer(f.next(), exception_code::illegal_data_value);
    CHECK(f.outcomes() == outcome_list{{2, 3}});
    CHECK(f.word("D100") == 1);
    CHECK(f.word("D101") == 2);
    f.memory_changed();
    CHECK(f.is_quiet());
}

TEST_CASE("write-through: what a program wrote while the station was busy goes out again")
{
    through_fixture f;
    f.set("D100", 5);
    f.line.memory_written();
    f.memory_changed();
    f.answer(f.next(), exception_code::server_device_busy);
    CHECK(f.word("D100") == 5);
    const time_point refused_at = f.now;
    const auto again = f.next();
    CHECK(f.now >= refused_at + 1s);
    CHECK(std::get<write_multiple_registers>(again.request()).values == std::vector<std::uint16_t>{5, 0});
}

TEST_CASE("write-through: what is changed back while a write is under way is written, too")
{
    through_fixture f;
    f.device_has(1, 2);
    f.client_writes(7, 2);
    const auto q = f.next();
    f.set("D100", 1);  // by a program
    f.line.memory_written();
    f.memory_changed();
    f.answer(q, written{});
    CHECK(f.outcomes() == outcome_list{{2, 0}});
    const auto back = f.next();
    CHECK(std::get<write_multiple_registers>(back.request()).values == std::vector<std::uint16_t>{1, 2});
}

TEST_CASE("write-through: a station that does not answer is 0B, at once when it is known to be down")
{
    through_fixture f;
    f.device_has(1, 2);
    f.client_writes(7, 8);
    f.fail(f.next());
    CHECK(f.outcomes() == outcome_list{{2, 0x0B}});
    CHECK(f.word("D100") == 1);
    f.memory_changed();
    CHECK(f.is_quiet());
    f.client_writes(9, 9);
    f.fail(f.next());
    CHECK(f.outcomes() == outcome_list{{3, 0x0B}});
    f.memory_changed();

    CHECK(f.client_writes(4, 4) == numbers{4});  // down now
    CHECK(f.outcomes() == outcome_list{{4, 0x0B}});
    CHECK(f.word("D100") == 1);
}

TEST_CASE("write-through: without the port it is 0A, also for those who wait when it is lost")
{
    through_fixture f;
    f.device_has(1, 2);
    f.client_writes(7, 8);
    f.line.port_lost("unplugged");
    CHECK(f.outcomes() == outcome_list{{2, 0x0A}});
    CHECK(f.word("D100") == 1);
    f.memory_changed();
    f.client_writes(9, 9);
    CHECK(f.outcomes() == outcome_list{{3, 0x0A}});
    CHECK(f.word("D100") == 1);
}

TEST_CASE("write-through: who writes while a write is on its way waits for the next one, and is not undone")
{
    through_fixture f;
    f.device_has(1, 2);
    f.client_writes(3, 3);
    const auto first = f.next();
    f.client_writes(4, 4);
    f.client_writes(5, 5);
    f.answer(first, exception_code::server_device_busy);
    CHECK(f.outcomes() == outcome_list{{2, 6}});
    CHECK(f.word("D100") == 5);
    const auto second = f.next();
    CHECK(std::get<write_multiple_registers>(second.request()).values == std::vector<std::uint16_t>{5, 5});
    f.answer(second, written{});
    CHECK(f.outcomes() == outcome_list{{3, 0}, {4, 0}});
    CHECK(f.is_quiet());
}

namespace {

// A pump with a write-through route, and a read when there are polls.
struct lost_fixture : fx3u_fixture {
    explicit lost_fixture(bool with_polls)
    {
        line.add_route(route_to("D300", table::holding_registers, 7, 2, direction::write_through), 0, 1s);
        if (with_polls)
            line.add_route(route_to("D310", table::holding_registers, 50, 1), 0, 1s);
        line.port_opened();
        line.start(t0);
    }
    void client_writes(std::uint16_t value)
    {
        set("D300", value);
        line.write_through(plc);
        for (const plc::change& each : plc.memory().take_changes())
            line.memory_changed(plc, each);
        line.memory_written();
    }
    client_line::question next()
    {
        auto q = line.next(now);
        for (int i = 0; !q && i < 100; ++i)
            q = line.next(now = line.wake_at(now));
        REQUIRE(q.has_value());
        return *q;
    }
    void fail(const client_line::question& q)
    {
        now += 500ms;
        line.failed(q, make_error_code(errc::timed_out), now, {1, now - 200ms});
        line.take_through();
    }

    client_line line{"bus 2", {{"pump", unit_id{5}, hasty}}, {.longest_silence = 10s}};
    time_point now = t0;
};

bool is_write(const client_line::question& q) { return std::holds_alternative<write_multiple_registers>(q.request()); }

}  // namespace

TEST_CASE("write-through: a write that failed does not stop the polls of its station, nor is it repeated")
{
    lost_fixture f(true);
    f.client_writes(7);
    client_line::question q = f.next();
    REQUIRE(is_write(q));
    f.fail(q);
    CHECK(f.word("D300") == 0);
    const time_point failed_at = f.now;
    for (int i = 0; i < 5; ++i) {
        q = f.next();
        REQUIRE_FALSE(is_write(q));
        if (i == 0)
            CHECK(f.now >= failed_at + hasty.response_timeout);  // an answer that comes late meets no other question
        if (i < 2)
            f.fail(q);
        else
            f.line.answered(q, registers_read{{1}}, f.now += 20ms, noon);
    }
    CHECK(f.line.health_of(0) == health::healthy);
}

TEST_CASE("write-through: a station without polls that is down is probed by a read, not by values that nobody wrote")
{
    lost_fixture f(false);
    for (int i = 0; i < 2; ++i) {
        f.client_writes(7);
        client_line::question q = f.next();
        REQUIRE(is_write(q));
        f.fail(q);
    }
    REQUIRE(f.line.health_of(0) == health::down);
    for (int i = 0; i < 3; ++i) {
        const client_line::question q = f.next();
        CHECK(q.request() == modbus::request{read_table{table::holding_registers, address{7}, 2}});
        if (i < 2)
            f.fail(q);
        else
            f.line.answered(q, registers_read{{55, 66}}, f.now += 20ms, noon);
    }
    CHECK(f.line.health_of(0) == health::healthy);
    CHECK(f.word("D300") == 0);  // what was read is nobody's
    CHECK_FALSE(f.line.next(f.now += 1min));
    f.client_writes(8);
    CHECK(is_write(f.next()));
}

TEST_CASE("write-through: a station that only others asked while it was silent is found again")
{
    lost_fixture f(false);
    for (int i = 0; i < 2; ++i) {
        f.line.forward(unit_id{5}, read_table{table::coils, address{0}, 1});
        f.fail(f.next());
    }
    REQUIRE(f.line.health_of(0) == health::down);
    f.line.answered(f.next(), registers_read{{1, 2}}, f.now += 20ms, noon);
    CHECK(f.line.health_of(0) == health::healthy);
}

TEST_SUITE_END();
