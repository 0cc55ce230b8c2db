// What answers do to memory and quality.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

TEST_CASE("modbus line: a question knows its station and when it was asked")
{
    line_fixture f;
    f.add_reads();
    const auto first = f.next();
    CHECK(first.unit == unit_id{5});
    CHECK(first.request() == request{read_table{table::holding_registers, address{0x10}, 2}});
    CHECK(first.timing.retries == 2);
    CHECK(first.asked_at == t0);
    f.answer(first, registers_read{{1, 2}});

    const auto second = f.next();
    CHECK(second.unit == unit_id{6});
    CHECK(second.timing.response_timeout == 200ms);
    CHECK(second.asked_at == t0 + duration(1s) / 3);  // the first round takes a second
}

TEST_CASE("modbus line: a read lands in the memory, with quality good and the time of the answer")
{
    line_fixture f;
    f.add_reads();
    CHECK(f.line.routes_total() == 3);
    CHECK(f.line.routes_up() == 0);
    f.answer(f.next(), registers_read{{0x1234, 0xABCD}}, noon);
    CHECK(f.word("D100") == 0x1234);
    CHECK(f.word("D101") == 0xABCD);
    CHECK(f.line.routes_up() == 1);
    f.answer(f.next(), bits_read{{true, false, true}});
    CHECK(f.bit("M100"));
    CHECK(f.bit("M102"));
    CHECK(f.line.routes_up() == 2);

    const sample s = f.said("D100");
    CHECK(s.state == quality::good);
    CHECK(s.source == noon);
    CHECK(s.words == std::vector<std::uint16_t>{0x1234, 0xABCD});
    CHECK(f.line.take_events().empty());
}

TEST_CASE("modbus line: an exception is a device error with its reason, said once; the station is not to blame")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", table::holding_registers, 0x10, 1), 0, 3s);
    f.line.start(t0);
    f.answer(f.next(), registers_read{{7}}, noon);
    for (int i = 0; i < 5; ++i) {
        const auto q = f.next();
        CHECK(q.timing.retries == 2);  // healthy
        f.answer(q, exception_code::illegal_data_address, wall_time{99});
    }
    const sample s = f.said("D100");
    CHECK(s.state == quality::device_error);
    CHECK(s.source == noon);
    CHECK(s.words == std::vector<std::uint16_t>{7});
    CHECK(f.word("D100") == 7);

    auto events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].level == line_event::severity::warning);
    CHECK(events[0].text ==
          "line bus 1, route D100: line bus 1, station pump (unit 5) refuses: exception 02 (illegal data address)");

    f.answer(f.next(), exception_code::server_device_busy);  // another reason is said again
    CHECK(f.line.take_events().size() == 1);
    f.answer(f.next(), exception_code{0xAB});
    events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text.find("exception AB (unknown exception)") != std::string::npos);

    f.answer(f.next(), registers_read{{8}});
    events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text == "line bus 1, route D100: accepted again");
    CHECK(f.said("D100").state == quality::good);
}

TEST_SUITE_END();
