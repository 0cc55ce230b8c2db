// Routes that write what a PLC holds to a station.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

TEST_CASE("modbus line: a write route goes out when its devices change, not at start")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0x20, 2, direction::write), 0, {});
    f.line.start(t0);
    CHECK_FALSE(f.line.next(t0 + 1min).has_value());

    f.set("D99", 1);
    f.set("D102", 1);
    CHECK_FALSE(f.memory_changed());
    CHECK_FALSE(f.line.next(t0 + 1min).has_value());

    f.set("D101", 42);
    CHECK(f.memory_changed());
    const auto q = f.line.next(t0 + 1min);
    REQUIRE(q.has_value());
    CHECK(q->request() == request{write_multiple_registers{address{0x20}, {0, 42}}});
    f.line.answered(*q, written{}, t0 + 1min + 20ms, noon);
    CHECK_FALSE(f.line.next(t0 + 2min).has_value());

    const auto samples = f.line.take_samples(t0 + 2min);
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].state == quality::good);
    CHECK(samples[0].words == std::vector<std::uint16_t>{0, 42});
    CHECK(samples[0].source == noon);
}

TEST_CASE("modbus line: the value that goes out is the one of the moment it goes out")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0x20, 1, direction::write), 0, {});
    f.line.start(t0);
    for (std::uint16_t value = 1; value <= 3; ++value) {
        f.set("D100", value);
        CHECK(f.memory_changed());
    }
    const auto q = f.line.next(t0);
    REQUIRE(q.has_value());
    CHECK(q->request() == request{write_single_register{address{0x20}, 3}});

    f.set("D100", 4);  // while it is on its way
    CHECK(f.memory_changed());
    f.line.answered(*q, written{}, t0 + 20ms, noon);
    CHECK(f.line.next(t0 + 20ms)->request() == request{write_single_register{address{0x20}, 4}});
}

TEST_CASE("modbus line: what one route reads, another may write elsewhere")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::input_registers, 0, 1), 0, 1s);
    f.line.add_route(f.route_to("D100", table::holding_registers, 0x20, 1, direction::write), 0, {});
    f.line.start(t0);
    const auto read = f.line.next(t0);
    f.line.answered(*read, registers_read{{5}}, t0 + 20ms, noon);
    CHECK(f.memory_changed());
    CHECK(f.line.next(t0 + 20ms)->request() == request{write_single_register{address{0x20}, 5}});
}

TEST_CASE("modbus line: a write that the port swallowed goes out again, a refused one waits for the next change")
{
    line_fixture f;
    f.line.add_route(f.route_to("M0", table::coils, 0, 1, direction::write), 0, {});
    f.line.start(t0);
    f.set_bit("M0", true);
    f.memory_changed();
    const auto swallowed = f.line.next(t0);
    f.line.interrupted(*swallowed);
    const auto again = f.line.next(t0 + 1s);
    REQUIRE(again.has_value());
    CHECK(again->request() == request{write_single_coil{address{0}, true}});

    f.line.answered(*again, exception_code::illegal_data_address, t0 + 1s, noon);
    CHECK_FALSE(f.line.next(t0 + 1h).has_value());
    CHECK(f.line.take_samples(t0 + 1h)[0].state == quality::device_error);
    f.set_bit("M0", false);
    f.memory_changed();
    CHECK(f.line.next(t0 + 1h)->request() == request{write_single_coil{address{0}, false}});
}

TEST_CASE("modbus line: a neighbouring bit of the same register sends nothing")
{
    line_fixture f;
    f.line.add_route(f.route_to("M10", table::coils, 0, 1, direction::write), 0, {});
    f.line.start(t0);
    f.set_bit("M9", true);
    f.set_bit("M11", true);
    CHECK_FALSE(f.memory_changed());
    CHECK_FALSE(f.line.next(t0).has_value());
}

TEST_SUITE_END();
