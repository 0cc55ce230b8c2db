// Orders on routes of every direction that writes: who gave one hears what the station said.
#include "bridge/orders/memory_write.hpp"
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

using words = std::vector<std::uint16_t>;

struct order_fixture : line_fixture {
    explicit order_fixture(direction way = direction::write, bool is_polled = false)
    {
        line.add_route(route_to("D100", table::holding_registers, 0, 2, way), 0, 1s);
        if (is_polled)
            line.add_route(route_to("D200", table::input_registers, 0, 2), 0, 1s);
        line.port_opened();
        line.start(t0);
        for (int i = 0; way == direction::read_write && i < 1; ++i)
            answer(next(), registers_read{{0, 0}});
        memory_changed();
    }
    memory_write writes(std::uint16_t first, std::uint16_t second)
    {
        memory_write made({&plc, at("D100"), 32});
        made.write({false, 2, {first, second}});
        made.written();
        numbers = line.order(plc, made.change());
        line.memory_written();
        memory_changed();
        return made;
    }
    client_line::question next_write()
    {
        for (int i = 0; i < 10; ++i) {
            auto q = next();
            if (std::holds_alternative<write_multiple_registers>(q.request()))
                return q;
            answer(q, registers_read{{word("D100"), word("D101")}});
            memory_changed();
        }
        FAIL("nothing is written");
        return next();
    }
    static words sent(const client_line::question& q) { return std::get<write_multiple_registers>(q.request()).values; }
    client_line::through_outcome outcome()
    {
        const auto all = line.take_through();
        REQUIRE(all.size() == 1);
        CHECK(all[0].number == numbers.back());
        return all[0];
    }
    void device_has(std::uint16_t first, std::uint16_t second)
    {
        writes(first, second).end();
        answer(next_write(), written{});
        line.take_through();
        memory_changed();
    }
    // As the service does it when nobody began in time.
    void expires(memory_write& given)
    {
        given.take_back();
        line.withdraw(numbers);
        given.end();
        line.memory_written();
        memory_changed();
    }
    bool nothing_is_written()
    {
        for (const time_point end = now + 5s; now < end;) {
            const auto q = line.next(now);
            if (!q) {
                now = std::max(now + 1ms, std::min(end, line.wake_at(now)));
                continue;
            }
            if (!std::holds_alternative<read_table>(q->request()))
                return false;
            answer(*q, registers_read{{word("D100"), word("D101")}});
            memory_changed();
        }
        return true;
    }
    std::vector<std::uint64_t> numbers{};
};

constexpr direction all_ways[] = {direction::write, direction::write_through, direction::read_write,
                                  direction::periodic_write};

}  // namespace

TEST_CASE("orders: each direction that writes asks its station, also for what stays the same, and tells")
{
    for (const direction way : all_ways) {
        CAPTURE(static_cast<int>(way));
        order_fixture f(way);
        for (int turn = 0; turn < 2; ++turn) {
            f.writes(1, 2).end();
            REQUIRE(f.numbers.size() == 1);
            CHECK_FALSE(f.line.has_begun(f.numbers[0]));
            const auto q = f.next_write();
            CHECK(f.line.has_begun(f.numbers[0]));
            CHECK(f.line.take_through().empty());
            CHECK(order_fixture::sent(q) == words{1, 2});
            f.answer(q, written{});
            CHECK_FALSE(f.outcome().failed);
            f.memory_changed();
        }
    }
}

TEST_CASE("orders: what the station refuses comes with its code; only write-through takes it back")
{
    for (const direction way : all_ways) {
        CAPTURE(static_cast<int>(way));
        order_fixture f(way);
        f.device_has(1, 2);
        f.writes(7, 8).end();
        f.answer(f.next_write(), exception_code::illegal_data_value);
        const auto outcome = f.outcome();
        CHECK(outcome.failed == exception_code::illegal_data_value);
        CHECK(outcome.device_code == 3);
        CHECK(outcome.goes_on == (way == direction::periodic_write));
        CHECK(outcome.reason.find("station pump (unit 5) refuses: exception 03") != std::string::npos);
        CHECK(f.word("D100") == (way == direction::write_through ? 1 : 7));
    }
}

TEST_CASE("orders: a silent station; the routes go on trying but for write-through")
{
    for (const direction way : all_ways) {
        CAPTURE(static_cast<int>(way));
        order_fixture f(way);
        f.writes(7, 8).end();
        f.fail(f.next_write());
        const auto outcome = f.outcome();
        CHECK(outcome.failed == exception_code::gateway_target_failed_to_respond);
        CHECK(outcome.device_code == 0);
        CHECK(outcome.goes_on == (way != direction::write_through));
        if (way == direction::write) {
            CHECK(order_fixture::sent(f.next_write()) == words{7, 8});
        }
    }
}

TEST_CASE("orders: a station that is known to be down, and an absent port, are told at once")
{
    order_fixture f;
    f.writes(1, 1).end();
    for (int i = 0; i < 3; ++i)
        f.fail(f.next_write());
    f.line.take_through();
    f.writes(2, 2).end();
    CHECK(f.outcome().failed == exception_code::gateway_target_failed_to_respond);
    f.answer(f.next_write(), written{});  // the probe brings what was written last
    f.line.port_lost("unplugged");
    f.writes(3, 3).end();
    const auto outcome = f.outcome();
    CHECK(outcome.failed == exception_code::gateway_path_unavailable);
    CHECK(outcome.goes_on);
}

TEST_CASE("orders: those who wait while their station goes down by another question are told at once")
{
    for (const direction way : {direction::write, direction::write_through, direction::periodic_write}) {
        CAPTURE(static_cast<int>(way));
        order_fixture f(way, true);
        f.device_has(1, 2);
        const auto poll = [&f] {
            auto q = f.next();
            while (!std::holds_alternative<read_table>(q.request())) {
                f.answer(q, written{});
                q = f.next();
            }
            return q;
        };
        f.fail(poll());
        const auto second = poll();  // the station is suspect, and is asked
        f.writes(7, 8).end();
        CHECK(f.line.take_through().empty());
        f.fail(second);
        const auto outcome = f.outcome();
        CHECK(outcome.failed == exception_code::gateway_target_failed_to_respond);
        CHECK(outcome.goes_on == (way != direction::write_through));
        CHECK(f.word("D100") == (way == direction::write_through ? 1 : 7));
    }
}

TEST_CASE("orders: those who wait when the port is lost are told")
{
    order_fixture f;
    f.writes(1, 1).end();
    f.line.port_lost("unplugged");
    CHECK(f.outcome().failed == exception_code::gateway_path_unavailable);
}

TEST_CASE("orders: only routes whose devices were written are asked")
{
    order_fixture f;
    CHECK(f.line.order(f.plc, {f.at("D102").area, f.at("D102").bit, 16}).empty());
    CHECK(f.line.order(f.plc, {f.at("D101").area, f.at("D101").bit, 16}).size() == 1);
}

TEST_CASE("orders: one that expires before its question is out has no effect")
{
    for (const direction way : all_ways) {
        CAPTURE(static_cast<int>(way));
        order_fixture f(way);
        auto given = f.writes(7, 8);  // nothing was ever written
        f.expires(given);
        CHECK(f.word("D100") == 0);
        CHECK(f.nothing_is_written());
        if (way != direction::periodic_write) {
            f.device_has(1, 2);
            given = f.writes(7, 8);
            f.expires(given);
            CHECK(f.word("D100") == 1);
            CHECK(f.nothing_is_written());
        }
        CHECK(f.line.take_through().empty());
        f.set("D100", 9);  // the next one is written as ever
        f.line.memory_written();
        f.memory_changed();
        CHECK(order_fixture::sent(f.next_write())[0] == 9);
    }
}

TEST_CASE("orders: one that expires leaves alone what somebody else wrote meanwhile")
{
    order_fixture f;
    f.device_has(1, 2);
    auto given = f.writes(7, 8);
    f.set("D101", 8);  // the same value: it is his now
    f.expires(given);
    CHECK(f.word("D101") == 8);
    CHECK(order_fixture::sent(f.next_write()) == words{7, 8});

    order_fixture g;
    g.device_has(1, 2);
    g.set("D101", 5);  // waits to be written
    g.memory_changed();
    given = g.writes(7, 5);
    g.expires(given);
    CHECK(order_fixture::sent(g.next_write()) == words{1, 5});
}

TEST_CASE("orders: of two that wait the one that expires does not take the other's question along")
{
    order_fixture f;
    f.device_has(1, 2);
    auto first = f.writes(3, 3);
    const auto first_numbers = f.numbers;
    f.writes(4, 4).end();
    first.take_back();
    f.line.withdraw(first_numbers);
    f.memory_changed();
    CHECK(f.word("D100") == 4);
    f.answer(f.next_write(), written{});
    CHECK_FALSE(f.outcome().failed);
}

TEST_SUITE_END();
