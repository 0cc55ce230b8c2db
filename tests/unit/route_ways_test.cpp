// Read-write and periodic-write routes, and what the memory shows when a station is lost.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

using regs = std::vector<std::uint16_t>;

bool is_write(const client_line::question& q)
{
    return std::holds_alternative<write_multiple_registers>(q.request()) ||
           std::holds_alternative<write_single_register>(q.request());
}

struct both_ways : line_fixture {
    both_ways()
    {
        line.add_route(route_to("D100", table::holding_registers, 0, 2, direction::read_write), 0, 1s);
        line.port_opened();
        line.start(t0);
    }
    void read(const regs& values)
    {
        const auto q = next();
        REQUIRE_FALSE(is_write(q));
        answer(q, registers_read{values});
        memory_changed();
    }
    void expect_write(const regs& values)
    {
        const auto q = next();
        REQUIRE(is_write(q));
        CHECK(std::get<write_multiple_registers>(q.request()).values == values);
        answer(q, written{});
        memory_changed();
    }
};

}  // namespace

TEST_CASE("read-write: what is read is not written back")
{
    both_ways f;
    f.read({1, 2});
    CHECK(f.word("D101") == 2);
    f.read({3, 4});
    CHECK(f.word("D100") == 3);
    CHECK(f.line.rows() == 2);
    CHECK(f.line.routes_total() == 1);
    CHECK(f.line.routes_up() == 1);
    CHECK(f.line.take_samples(f.now).size() == 1);
}

TEST_CASE("read-write: what somebody else changes is written, and read back at once")
{
    both_ways f;
    f.read({1, 2});
    const time_point before = f.now;
    f.set("D101", 20);
    CHECK(f.memory_changed());
    f.expect_write({1, 20});
    f.read({1, 19});  // the station has its own idea
    CHECK(f.now - before < 500ms);
    CHECK(f.word("D101") == 19);
}

TEST_CASE("read-write: a read that was under way does not undo a write")
{
    both_ways f;
    f.read({1, 2});
    const auto q = f.next();
    f.set("D100", 10);
    CHECK(f.memory_changed());
    f.answer(q, registers_read{{1, 2}});
    CHECK(f.word("D100") == 10);
    f.memory_changed();
    f.expect_write({10, 2});

    // Not drained yet when the answer comes: seen all the same.
    const auto second = f.next();
    f.set("D100", 11);
    f.answer(second, registers_read{{10, 2}});
    CHECK(f.word("D100") == 11);
    f.memory_changed();
    f.expect_write({11, 2});
}

TEST_CASE("read-write: a read that was asked before the write and answered after it does not undo it")
{
    both_ways f;
    f.read({1, 2});
    const auto old = f.next();
    f.set("D100", 10);
    f.memory_changed();
    const auto writing = f.line.next(f.now);  // a TCP line asks several at a time
    REQUIRE(writing.has_value());
    REQUIRE(is_write(*writing));
    f.answer(*writing, written{});
    f.memory_changed();
    f.answer(old, registers_read{{1, 2}});
    f.memory_changed();
    CHECK(f.word("D100") == 10);
    f.read({10, 2});
    CHECK(f.word("D100") == 10);
}

TEST_CASE("read-write: what is changed and changed back while a write is under way is written, too")
{
    both_ways f;
    f.read({1, 2});
    f.set("D100", 7);
    CHECK(f.memory_changed());
    const auto q = f.next();
    REQUIRE(is_write(q));
    f.set("D100", 1);
    f.memory_changed();
    f.answer(q, written{});
    f.memory_changed();
    f.read({7, 2});  // writes leave every other turn to the polls
    f.expect_write({1, 2});
    f.read({1, 2});
    CHECK(f.word("D100") == 1);
}

TEST_CASE("read-write: a read that is answered while a write is under way changes nothing, whatever the memory holds")
{
    both_ways f;
    f.read({1, 2});
    f.set("D100", 7);
    CHECK(f.memory_changed());
    const auto q = f.next();
    REQUIRE(is_write(q));
    f.set("D100", 1);
    f.memory_changed();
    const auto read = f.next();  // over MODBUS TCP both are out at a time
    REQUIRE_FALSE(is_write(read));
    f.answer(read, registers_read{{7, 2}});
    CHECK(f.word("D100") == 1);
}

TEST_CASE("read-write: when the station refuses, its own value comes back")
{
    both_ways f;
    f.read({1, 2});
    f.set("D100", 999);
    f.memory_changed();
    const auto q = f.next();
    REQUIRE(is_write(q));
    f.answer(q, exception_code::illegal_data_value);
    f.memory_changed();
    f.read({1, 2});
    CHECK(f.word("D100") == 1);
    CHECK(f.line.route_at(0).errors == 1);
}

TEST_CASE("periodic write: begins with the first write to its devices, then goes on each period")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0, 1, direction::periodic_write), 0, 1s);
    f.line.port_opened();
    f.line.start(t0);
    CHECK_FALSE(f.line.next(t0 + 5s).has_value());
    f.set("D99", 1);
    f.memory_changed();
    CHECK_FALSE(f.line.memory_written());
    f.set("D100", 0);  // as it was: no change, but somebody means it
    CHECK_FALSE(f.memory_changed());
    CHECK(f.line.memory_written());

    f.now = t0 + 5s;
    std::vector<time_point> at;
    for (int i = 0; i < 5; ++i) {
        const auto q = f.next();
        at.push_back(f.now);
        CHECK(std::get<write_single_register>(q.request()).value == 0);
        f.answer(q, written{});
    }
    for (std::size_t i = 1; i < at.size(); ++i)
        CHECK(at[i] - at[i - 1] <= 1s + 20ms);
    CHECK(at[4] - at[0] >= 3900ms);

    f.set("D100", 7);
    CHECK(f.memory_changed());
    const time_point before = f.now;
    const auto q = f.next();
    CHECK(f.now - before < 100ms);  // a change does not wait
    CHECK(std::get<write_single_register>(q.request()).value == 7);
    f.set("D100", 8);  // while it is on the line
    f.memory_changed();
    f.answer(q, written{});
    const auto next = f.next();
    CHECK(f.now - before < 200ms);
    CHECK(std::get<write_single_register>(next.request()).value == 8);
}

TEST_CASE(
    "on loss: the memory shows the route's own value when the station is lost, and the station's again after that")
{
    line_fixture f;
    route zero = f.route_to("D100", table::holding_registers, 0, 2);
    zero.substitute = {0, 99};
    f.line.add_route(std::move(zero), 0, 1s);
    f.line.add_route(f.route_to("D200", table::input_registers, 9, 1), 0, 1s);
    f.line.port_opened();
    f.line.start(t0);
    for (int i = 0; i < 2; ++i) {
        const auto q = f.next();
        const bool first = std::get<read_table>(q.request()).count == 2;
        f.answer(q, registers_read{first ? regs{5, 6} : regs{7}});
    }
    f.fail(f.next());
    CHECK(f.word("D101") == 6);  // one silence is no loss
    f.fail(f.next());
    CHECK(f.word("D100") == 0);
    CHECK(f.word("D101") == 99);
    CHECK(f.word("D200") == 7);
    const sample lost = f.said("D100");
    CHECK(lost.state == quality::substituted);
    CHECK(lost.words == regs{0, 99});
    CHECK(lost.source == noon);
    CHECK(f.said("D200").state == quality::comm_error);
    const auto probe = f.next();
    f.fail(probe);
    CHECK(f.said("D100").state == quality::substituted);
    for (int i = 0; i < 3; ++i) {
        const auto q = f.next();
        const bool first = std::get<read_table>(q.request()).count == 2;
        f.answer(q, registers_read{first ? regs{5, 6} : regs{7}});
    }
    CHECK(f.said("D100").state == quality::good);
    CHECK(f.word("D101") == 6);

    f.line.port_lost("unplugged");
    CHECK(f.word("D101") == 99);
    CHECK(f.said("D100").state == quality::substituted);
}

TEST_CASE("on loss: what a read-write route puts into memory is not written to the station")
{
    line_fixture f;
    route r = f.route_to("D100", table::holding_registers, 0, 1, direction::read_write);
    r.substitute = {0};
    f.line.add_route(std::move(r), 0, 1s);
    f.line.port_opened();
    f.line.start(t0);
    f.answer(f.next(), registers_read{{5}});
    f.memory_changed();
    f.line.port_lost("unplugged");
    CHECK(f.word("D100") == 0);
    CHECK_FALSE(f.memory_changed());
    f.line.port_opened();
    const auto q = f.next();
    CHECK_FALSE(is_write(q));
}

TEST_SUITE_END();
