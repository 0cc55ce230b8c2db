// Whoever has a request forwarded hears of each attempt that failed, before the answer.
#include "bridge/routes/client_line.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace std::chrono_literals;

TEST_CASE("forwarding: each failed attempt is told, of the request that it belongs to, and once")
{
    const time_point now{1s};
    const modbus::request read = modbus::read_table{modbus::table::holding_registers, {}, 1};
    client_line line("line", {}, {.longest_silence = 1s});
    line.start(now);
    line.port_opened();
    const auto first = line.forward(modbus::unit_id{1}, read);
    const auto second = line.forward(modbus::unit_id{2}, read);
    REQUIRE((first && second));

    const auto asked = line.next(now);
    REQUIRE(asked.has_value());
    CHECK(line.take_forward_faults().empty());
    const modbus::answer_fault stranger{errc::unexpected_answer, modbus::frame{modbus::unit_id{9}, {0x03}}};
    CHECK(line.attempt_failed(*asked, {errc::timed_out, {}}));
    CHECK(line.attempt_failed(*asked, stranger));
    const auto told = line.take_forward_faults();
    REQUIRE(told.size() == 2);
    CHECK(told[0].ticket == *first);
    CHECK(told[0].why == modbus::answer_fault{errc::timed_out, {}});
    CHECK(told[1].why == stranger);
    CHECK(line.take_forward_faults().empty());
    CHECK(line.take_forwarded().empty());
    line.failed(*asked, make_error_code(errc::unexpected_answer), now);
    CHECK(line.take_forwarded().size() == 1);

    const auto next = line.next(now);
    REQUIRE(next.has_value());
    line.attempt_failed(*next, {errc::bad_checksum, {}});
    CHECK(line.take_forward_faults().at(0).ticket == *second);
}

TEST_SUITE_END();
