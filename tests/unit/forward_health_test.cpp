// What forwarded requests learn of a station's health, and what it means for them.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

const modbus::request some_read = modbus::read_table{modbus::table::holding_registers, modbus::address{0}, 1};
const modbus::unit_id stranger{77};
const modbus::unit_id pump{5};

struct forwarding_fixture : line_fixture {
    forwarding_fixture() { line.port_opened(); }

    void ask(modbus::unit_id unit)
    {
        line.forward(unit, some_read);
        line.look_at_forwarded(now);
    }
    // The forwarded request that goes now.
    std::optional<client_line::question> forwarded()
    {
        const auto q = line.next(now);
        if (q && std::holds_alternative<forward_ticket>(q->origin))
            return q;
        return std::nullopt;
    }
    void silence(const client_line::question& q)
    {
        const time_point sent = now;
        now += 500ms;
        line.failed(q, make_error_code(errc::timed_out), now, {1, sent});
    }
    std::vector<result<modbus::response>> answers()
    {
        std::vector<result<modbus::response>> all;
        for (forward_answer& each : line.take_forwarded())
            all.push_back(std::move(each.response));
        return all;
    }
    std::string events()
    {
        std::string all;
        for (const line_event& each : line.take_events())
            all += each.text + "\n";
        return all;
    }
};

}  // namespace

TEST_CASE(
    "forwarding: a unit without routes that is silent twice costs no more line time, but for a request now and then")
{
    forwarding_fixture f;
    for (int i = 0; i < 2; ++i) {
        f.now += 10s;
        f.ask(stranger);
        const auto q = f.forwarded();
        REQUIRE(q);
        f.silence(*q);
        REQUIRE(f.answers().size() == 1);
    }
    CHECK(f.events() == "line bus 1, unit 77 does not answer (no answer): requests to it fail at once, until one "
                        "that is let through now and then is answered\n");
    f.ask(stranger);
    const auto refused = f.answers();  // at once, before the line is looked at
    REQUIRE(refused.size() == 1);
    CHECK(refused[0].error() == errc::timed_out);
    CHECK_FALSE(f.forwarded());

    f.now += 11s;  // its probe, within the share of probes
    f.ask(stranger);
    CHECK(f.answers().empty());
    const auto let_through = f.forwarded();
    REQUIRE(let_through);
    f.answer(*let_through, modbus::registers_read{{1}});
    CHECK(f.events() == "line bus 1, unit 77 answers again\n");
    f.ask(stranger);
    CHECK(f.forwarded());
}

TEST_CASE("forwarding: a station with polls is not given up because it ignores what others ask; the next poll shows")
{
    forwarding_fixture f;
    f.add_reads();
    f.answer(f.next(), modbus::registers_read{{1, 2}});
    f.answer(f.next(), modbus::bits_read{{true, false, true}});
    f.answer(f.next(), modbus::registers_read{{3}});
    for (int i = 0; i < 5; ++i) {
        f.ask(pump);
        const auto q = f.forwarded();
        REQUIRE(q);
        f.silence(*q);
        CHECK(f.answers().size() == 1);

        // What comes late does not meet another question to this station, nor does the poll wait for its period.
        const time_point silent_at = f.now;
        auto poll = f.next();
        while (poll.unit != pump) {
            f.answer(poll, modbus::bits_read{{true, false, true}});
            poll = f.next();
        }
        CHECK(f.now - silent_at >= 500ms);
        CHECK(f.now - silent_at <= 600ms);
        CHECK(poll.timing.retries == 0);
        const auto asked = std::get<modbus::read_table>(poll.request());
        f.answer(poll, modbus::registers_read{std::vector<std::uint16_t>(asked.count)});
        CHECK(f.said("D100").state != quality::comm_error);
        f.now += 10s;  // what came late is over
        while (const auto other = f.line.next(f.now)) {
            const auto& wanted = std::get<modbus::read_table>(other->request());
            if (wanted.from == modbus::table::discrete_inputs)
                f.answer(*other, modbus::bits_read{{true, false, true}});
            else
                f.answer(*other, modbus::registers_read{std::vector<std::uint16_t>(wanted.count)});
        }
    }
    CHECK(f.events().empty());
}

TEST_CASE("forwarding: to a station that polls took down requests fail at once, until a poll is answered")
{
    forwarding_fixture f;
    f.add_reads();
    f.fail(f.next());
    f.fail(f.next());
    while (f.line.take_events().empty())
        f.fail(f.next());
    for (const modbus::unit_id unit : {modbus::unit_id{5}, modbus::unit_id{6}}) {
        f.ask(unit);
        if (const auto at_once = f.answers(); !at_once.empty())
            CHECK(at_once[0].error() == errc::timed_out);
    }
}

TEST_CASE("forwarding: broadcasts have no health")
{
    forwarding_fixture f;
    for (int i = 0; i < 5; ++i) {
        f.line.forward(modbus::unit_id::broadcast, modbus::write_single_register{modbus::address{1}, 2});
        const auto q = f.forwarded();
        REQUIRE(q);
        f.answer(*q, modbus::no_response{});
        CHECK(f.answers().size() == 1);
    }
}

TEST_CASE("learned timeouts: between the bounds, and the whole time for a station that was silent once")
{
    client_line line("bus", {{"pump", pump, hasty, {}, 30ms}}, {.longest_silence = 10s});
    line.port_opened();
    time_point now = t0;
    for (int i = 0; i < 20; ++i) {
        line.forward(pump, some_read);
        const auto q = line.next(now);
        REQUIRE(q);
        CHECK(q->timing.response_timeout == (i < 8 ? 200ms : 30ms));
        now += 20ms;
        line.answered(*q, modbus::registers_read{{1}}, now, noon, {}, 5ms);
    }
    line.forward(pump, some_read);
    const auto q = line.next(now);
    line.failed(*q, make_error_code(errc::timed_out), now += 30ms, {1, now});
    now += 10s;
    line.forward(pump, some_read);
    CHECK(line.next(now)->timing.response_timeout == 200ms);
}

TEST_SUITE_END();
