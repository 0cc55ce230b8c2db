// What silence, a busy line and a lost port do to qualities and stations.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

TEST_CASE("modbus line: a failure keeps value and time, and the quality turns")
{
    line_fixture f;
    f.add_reads();
    f.answer(f.next(), registers_read{{7, 8}}, noon);
    f.answer(f.next(), bits_read{{true, true, true}});
    f.answer(f.next(), registers_read{{9}});
    f.said("D100");

    f.fail(f.next());
    const sample s = f.said("D100");
    CHECK(s.state == quality::comm_error);
    CHECK(s.source == noon);
    CHECK(s.words == std::vector<std::uint16_t>{7, 8});
    CHECK(f.word("D100") == 7);
    CHECK(f.line.routes_up() == 2);  // the other route of that station is not judged yet

    auto again = f.next();
    while (again.unit != unit_id{5}) {
        f.answer(again, bits_read{{true, true, true}});
        again = f.next();
    }
    CHECK(again.request() == request{read_table{table::holding_registers, address{0x10}, 2}});  // the same question
    CHECK(again.timing.retries == 0);
    f.answer(again, registers_read{{7, 9}}, wall_time{5});
    CHECK(f.said("D100").state == quality::good);
    CHECK(f.said("D100").source == wall_time{5});
}

TEST_CASE("modbus line: a station that is down takes all its routes with it, is said once and comes back")
{
    line_fixture f;
    f.add_reads();
    f.answer(f.next(), registers_read{{7, 8}});
    f.answer(f.next(), bits_read{{true, true, true}});
    f.answer(f.next(), registers_read{{9}});
    const auto fail_pump = [&] {
        for (;;) {
            const auto q = f.next();
            if (q.unit == unit_id{5}) {
                f.fail(q);
                return;
            }
            f.answer(q, bits_read{{true, true, true}});
        }
    };
    fail_pump();
    CHECK(f.line.take_events().empty());
    fail_pump();
    CHECK(f.said("D100").state == quality::comm_error);
    CHECK(f.said("D200").state == quality::comm_error);
    CHECK(f.said("M100").state == quality::good);
    CHECK(f.word("D200") == 9);

    const auto events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].level == line_event::severity::warning);
    CHECK(events[0].text == "line bus 1, station pump (unit 5) does not answer (no answer): its values are kept, it is "
                            "probed from now on");
    fail_pump();  // the probe
    fail_pump();
    CHECK(f.line.take_events().empty());

    for (auto q = f.next();; q = f.next()) {
        f.answer(q, q.unit == unit_id{5} ? response{registers_read{{7, 8}}} : response{bits_read{{true, true, true}}});
        if (q.unit == unit_id{5})
            break;
    }
    const auto back = f.line.take_events();
    REQUIRE(back.size() == 1);
    CHECK(back[0].level == line_event::severity::info);
    CHECK(back[0].text == "line bus 1, station pump (unit 5) answers again");
    CHECK(f.said("D100").state == quality::good);
    CHECK(f.said("D200").state == quality::comm_error);  // until it is read itself
}

TEST_CASE("modbus line: a line that was not free says nothing about the station")
{
    line_fixture f;
    f.add_reads();
    f.answer(f.next(), registers_read{{7, 8}});
    for (int i = 0; i < 6; ++i) {
        const auto q = f.next();
        CHECK(q.timing.retries == (q.unit == unit_id{5} ? 2 : 1));  // healthy
        f.fail(q, errc::line_not_quiet);
    }
    CHECK(f.said("D100").state == quality::comm_error);
    CHECK(f.word("D100") == 7);
    CHECK(f.line.take_events().empty());
}

TEST_CASE("modbus line: a lost port turns all qualities, keeps all values and blames no station")
{
    line_fixture f;
    f.add_reads();
    f.answer(f.next(), registers_read{{7, 8}});
    f.answer(f.next(), bits_read{{true, false, true}});
    const auto interrupted = f.next();
    f.line.interrupted(interrupted);
    f.line.port_lost("port absent");
    CHECK(f.line.routes_up() == 0);
    const auto samples = f.line.take_samples(f.now);
    REQUIRE(samples.size() == 3);
    for (const sample& each : samples)
        CHECK(each.state == quality::comm_error);
    CHECK(samples[0].words == std::vector<std::uint16_t>{7, 8});
    CHECK(f.word("D101") == 8);

    f.now += 1min;
    const auto again = f.next();
    CHECK(again.timing.retries == (again.unit == unit_id{5} ? 2 : 1));  // all are healthy
}

TEST_SUITE_END();
