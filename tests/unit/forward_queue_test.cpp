#include "bridge/routes/client_line.hpp"

#include <doctest/doctest.h>

namespace plcgw {
namespace {

const time_point t0 = time_point{} + std::chrono::hours(1);
const modbus::request ask_one = modbus::read_table{modbus::table::holding_registers, modbus::address{0}, 1};
const modbus::response seven = modbus::registers_read{{7}};

std::vector<forward_ticket> tickets_of(const std::vector<forward_answer>& answers)
{
    std::vector<forward_ticket> tickets;
    for (const forward_answer& each : answers)
        tickets.push_back(each.ticket);
    return tickets;
}

struct forwarding_line {
    forwarding_line() { line.port_opened(); }

    forward_ticket ask(unsigned unit)
    {
        return *line.forward(modbus::unit_id{static_cast<std::uint8_t>(unit)}, ask_one);
    }

    client_line line{"line", {}, {.longest_silence = std::chrono::seconds(1)}};
};

}  // namespace

TEST_SUITE_BEGIN("routes");

TEST_CASE("forwarding: a request whose asker left while it waited is not asked")
{
    forwarding_line f;
    const forward_ticket first = f.ask(1);
    const forward_ticket second = f.ask(2);
    f.ask(3);
    f.line.cancel(second);
    f.line.cancel(second);  // is no harm
    const auto asked = f.line.next(t0);
    REQUIRE(asked);
    CHECK(asked->unit == modbus::unit_id{1});
    f.line.answered(*asked, seven, t0, {});
    const auto next = f.line.next(t0);
    REQUIRE(next);
    CHECK(next->unit == modbus::unit_id{3});
    CHECK_FALSE(f.line.next(t0));
    CHECK(tickets_of(f.line.take_forwarded()) == std::vector{first});
}

TEST_CASE("forwarding: a line with only requests of those who left has nothing to do")
{
    forwarding_line f;
    const forward_ticket only = f.ask(1);
    CHECK(f.line.wake_at(t0) == t0);
    f.line.cancel(only);
    CHECK(f.line.wake_at(t0) > t0);
    CHECK_FALSE(f.line.next(t0));
    f.line.port_lost("test");
    CHECK(f.line.take_forwarded().empty());
}

TEST_CASE("forwarding: a request on the wire is not repeated for an asker who left, and its answer is dropped")
{
    forwarding_line f;
    const forward_ticket left = f.ask(1);
    const forward_ticket stays = f.ask(2);
    const auto first = f.line.next(t0);
    REQUIRE(first);
    CHECK(f.line.is_wanted(*first));
    f.line.cancel(left);
    CHECK_FALSE(f.line.is_wanted(*first));
    f.line.answered(*first, seven, t0, {});
    CHECK(f.line.take_forwarded().empty());
    const auto second = f.line.next(t0);
    REQUIRE(second);
    CHECK(f.line.is_wanted(*second));
    f.line.failed(*second, make_error_code(errc::timed_out), t0);
    CHECK_FALSE(f.line.is_wanted(*second));
    CHECK(tickets_of(f.line.take_forwarded()) == std::vector{stays});
}

TEST_CASE("forwarding: an answer that was not fetched yet goes with its asker")
{
    forwarding_line f;
    const forward_ticket left = f.ask(1);
    const auto asked = f.line.next(t0);
    REQUIRE(asked);
    f.line.answered(*asked, seven, t0, {});
    f.line.cancel(left);
    CHECK(f.line.take_forwarded().empty());
}

TEST_CASE("forwarding: who left makes place for others")
{
    forwarding_line f;
    std::vector<forward_ticket> all;
    while (const auto ticket = f.line.forward(modbus::unit_id{1}, ask_one))
        all.push_back(*ticket);
    CHECK(all.size() == 64);
    f.line.cancel(all[10]);
    CHECK(f.line.forward(modbus::unit_id{1}, ask_one));
    CHECK_FALSE(f.line.forward(modbus::unit_id{1}, ask_one));
}

TEST_SUITE_END();

}  // namespace plcgw
