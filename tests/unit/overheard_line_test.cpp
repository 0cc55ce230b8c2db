// The routes of a line on which another member of the pair asks.
#include "bridge/routes/route_status.hpp"
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

const unit_id pump{5};
const unit_id valve{6};

request read(table from, unsigned first, unsigned count)
{
    return read_table{from, address{static_cast<std::uint16_t>(first)}, static_cast<std::uint16_t>(count)};
}

// A standby: it hears what the other member asks, and what the stations say.
struct silent_line : line_fixture {
    void hear(unit_id unit, const request& asked, const std::optional<response>& answer)
    {
        now += 20ms;
        std::optional<station_answer> said;
        if (answer)
            said = *answer;
        line.overheard(unit, asked, said, now, noon);
        due = memory_changed() || due;
    }
    void add_write(const char* device, std::uint16_t first, std::uint16_t count, direction way)
    {
        line.add_route(route_to(device, table::holding_registers, first, count, way), 0, 1s);
        line.start(t0);
        line.fall_silent();
    }
    // The memory mirror, or a client, writes.
    void bring(const char* device, std::uint16_t value)
    {
        set(device, value);
        due = memory_changed() || due;
        due = line.memory_written() || due;
    }
    // What would be written by whoever begins to ask now; nothing within a second.
    std::optional<request> written_after_takeover()
    {
        line.begin_to_speak(now);
        const time_point end = now + 900ms;
        while (now < end) {
            const auto q = line.next(now);
            if (q && !std::holds_alternative<read_table>(q->request()))
                return q->request();
            if (q)
                line.answered(*q, response{exception_code::server_device_busy}, now, noon);
            now = std::max(now + 1ms, line.wake_at(now));
        }
        return std::nullopt;
    }
    bool due = false;
};

const request ten_is_one = write_single_register{address{10}, 1};
const request ten_is_two = write_single_register{address{10}, 2};

}  // namespace

TEST_CASE("overheard: answers fill the routes whose registers they hold, whatever the plan")
{
    silent_line f;
    f.add_reads();
    f.line.fall_silent();
    f.hear(pump, read(table::holding_registers, 0x0F, 4), registers_read{{9, 100, 101, 9}});
    CHECK(f.word("D100") == 100);
    CHECK(f.word("D101") == 101);
    CHECK(f.said("D100").state == quality::good);
    CHECK(f.last["D100"].source == noon);
    CHECK(f.last["D100"].words == std::vector<std::uint16_t>{100, 101});
    CHECK(f.last["D200"].state == quality::never_read);

    f.hear(valve, read(table::discrete_inputs, 0, 3), bits_read{{true, false, true}});
    CHECK(f.bit("M100"));
    CHECK_FALSE(f.bit("M101"));
    CHECK(f.said("M100").state == quality::good);
}

TEST_CASE("overheard: what is not the route's fills nothing")
{
    struct row {
        const char* name;
        unit_id unit;
        request asked;
        response answer;
    };
    const row rows[] = {
        {"a part of it", pump, read(table::holding_registers, 0x10, 1), registers_read{{7}}},
        {"the other part", pump, read(table::holding_registers, 0x11, 2), registers_read{{7, 7}}},
        {"another table", pump, read(table::input_registers, 0x10, 2), registers_read{{7, 7}}},
        {"another station", valve, read(table::holding_registers, 0x10, 2), registers_read{{7, 7}}},
        {"a stranger", unit_id{99}, read(table::holding_registers, 0x10, 2), registers_read{{7, 7}}},
        {"no values", pump, read_exception_status{}, exception_status_read{1}},
    };
    for (const row& each : rows) {
        CAPTURE(each.name);
        silent_line f;
        f.add_reads();
        f.hear(each.unit, each.asked, each.answer);
        CHECK(f.word("D100") == 0);
        CHECK(f.word("D101") == 0);
        CHECK(f.said("D100").state == quality::never_read);
    }
}

TEST_CASE("overheard: values age when nobody speaks")
{
    silent_line f;
    f.add_reads();
    f.hear(pump, read(table::holding_registers, 0x10, 2), registers_read{{1, 2}});
    f.now += 8s;
    f.line.take_samples(f.now);
    CHECK(f.line.route_at(0).state == quality::good);
    f.now += 2s;
    CHECK(f.said("D100").state == quality::stale);
    CHECK(f.word("D100") == 1);
    f.hear(pump, read(table::holding_registers, 0x10, 2), registers_read{{1, 2}});
    CHECK(f.said("D100").state == quality::good);
}

TEST_CASE("overheard: a port that is lost makes a comm error of all, as when we ask")
{
    silent_line f;
    f.add_reads();
    f.hear(pump, read(table::holding_registers, 0x10, 2), registers_read{{1, 2}});
    f.line.port_lost("port absent");
    CHECK(f.said("D100").state == quality::comm_error);
}

TEST_CASE("overheard: silence counts as it does for whoever asks")
{
    silent_line f;
    f.add_reads();
    f.hear(pump, read(table::holding_registers, 0x10, 2), registers_read{{1, 2}});
    const request asked = read(table::holding_registers, 0x10, 2);
    for (unsigned attempt = 0; attempt < patient.retries; ++attempt) {
        f.hear(pump, asked, std::nullopt);
        CHECK(f.line.health_of(0) == health::healthy);
        CHECK(f.said("D100").state == quality::good);
    }
    f.hear(pump, asked, std::nullopt);
    CHECK(f.line.health_of(0) == health::suspect);
    CHECK(f.said("D100").state == quality::comm_error);
    CHECK(f.last["D200"].state == quality::never_read);
    f.hear(pump, asked, std::nullopt);
    CHECK(f.line.health_of(0) == health::down);
    CHECK(f.said("D200").state == quality::comm_error);
    CHECK(f.line.health_of(1) == health::healthy);

    f.hear(pump, asked, registers_read{{3, 4}});
    CHECK(f.line.health_of(0) == health::healthy);
    CHECK(f.said("D100").state == quality::good);
    CHECK(f.word("D100") == 3);
}

TEST_CASE("overheard: a refusal is the route's if it asked for nothing else")
{
    silent_line f;
    f.add_reads();
    f.hear(pump, read(table::holding_registers, 0x10, 3), exception_code::illegal_data_address);
    CHECK(f.said("D100").state == quality::never_read);
    f.hear(pump, read(table::holding_registers, 0x10, 2), exception_code::illegal_data_address);
    CHECK(f.said("D100").state == quality::device_error);
    CHECK(f.line.health_of(0) == health::healthy);
}

TEST_CASE("overheard: what the other wrote is not written again, whether wire or mirror is first")
{
    for (const direction way : {direction::write, direction::read_write, direction::periodic_write}) {
        CAPTURE(static_cast<int>(way));
        silent_line f;
        f.add_write("D10", 10, 1, way);
        f.bring("D10", 1);
        CHECK(f.due);
        f.hear(pump, ten_is_one, written{});
        CHECK(f.word("D10") == 1);
        CHECK_FALSE(f.written_after_takeover());

        silent_line g;
        g.add_write("D10", 10, 1, way);
        g.hear(pump, ten_is_one, written{});
        CHECK(g.word("D10") == 1);
        g.bring("D10", 1);
        CHECK_FALSE(g.written_after_takeover());
    }
}

TEST_CASE("overheard: what the other did not come to is written")
{
    SUBCASE("nothing was heard")
    {
        silent_line f;
        f.add_write("D10", 10, 1, direction::write);
        f.bring("D10", 2);
        CHECK(f.written_after_takeover() == ten_is_two);
    }
    SUBCASE("an older write was heard")
    {
        silent_line f;
        f.add_write("D10", 10, 1, direction::write);
        f.bring("D10", 2);
        f.hear(pump, ten_is_one, written{});
        CHECK(f.word("D10") == 2);
        CHECK(f.written_after_takeover() == ten_is_two);
    }
    SUBCASE("nobody answered it")
    {
        silent_line f;
        f.add_write("D10", 10, 1, direction::write);
        f.bring("D10", 2);
        f.hear(pump, ten_is_two, std::nullopt);
        CHECK(f.written_after_takeover() == ten_is_two);
    }
    SUBCASE("the mirror comes after an old value, and behind it the new one")
    {
        silent_line f;
        f.add_write("D10", 10, 1, direction::write);
        f.hear(pump, ten_is_two, written{});
        f.bring("D10", 1);
        f.bring("D10", 2);
        CHECK_FALSE(f.written_after_takeover());
    }
}

TEST_CASE("overheard: a value that went on while our write was out is written again")
{
    silent_line f;
    f.add_write("D10", 10, 1, direction::write);
    f.hear(pump, ten_is_one, written{});
    f.line.begin_to_speak(f.now);
    f.bring("D10", 2);
    const auto q = f.next();
    CHECK(q.request() == ten_is_two);
    f.bring("D10", 1);  // as was heard, but the station will have 2
    f.answer(q, written{});
    CHECK(f.next().request() == ten_is_one);
}

TEST_CASE("overheard: a write of a part of a row completes what is known of it")
{
    silent_line f;
    f.add_write("D10", 10, 3, direction::write);
    f.hear(pump, write_multiple_registers{address{9}, {7, 8, 9}}, written{});
    CHECK(f.word("D10") == 8);
    CHECK(f.word("D11") == 9);
    CHECK(f.word("D12") == 0);
    CHECK_FALSE(f.due);
    f.hear(pump, write_single_register{address{12}, 5}, written{});
    CHECK(f.word("D12") == 5);
    CHECK_FALSE(f.written_after_takeover());
}

TEST_CASE("overheard: coils that were written come into the memory")
{
    silent_line f;
    f.line.add_route(f.route_to("M10", table::coils, 0, 3, direction::write), 0, 1s);
    f.line.start(t0);
    f.line.fall_silent();
    f.hear(pump, write_multiple_coils{address{0}, {true, false, true}}, written{});
    CHECK(f.bit("M10"));
    CHECK_FALSE(f.bit("M11"));
    CHECK(f.bit("M12"));
    f.hear(pump, write_single_coil{address{0}, false}, written{});
    CHECK_FALSE(f.bit("M10"));
    CHECK_FALSE(f.due);
}

TEST_CASE("overheard: a periodic write goes on after its period")
{
    silent_line f;
    f.add_write("D10", 10, 1, direction::periodic_write);
    f.hear(pump, ten_is_one, written{});
    const time_point heard = f.now;
    f.line.begin_to_speak(f.now);
    CHECK(f.next().request() == ten_is_one);
    CHECK(f.now == heard + 1s);
}

TEST_CASE("overheard: a silent line takes no requests of others")
{
    silent_line f;
    f.line.add_route(f.route_to("D10", table::holding_registers, 10, 1, direction::write_through), 0, 1s);
    f.line.port_opened();
    f.line.start(t0);
    f.line.forward(pump, read(table::holding_registers, 0, 1));
    f.set("D10", 3);
    CHECK(f.line.write_through(f.plc).size() == 1);
    f.line.fall_silent();
    CHECK(f.line.take_forwarded().size() == 1);
    REQUIRE(f.line.take_through().size() == 1);
    f.line.forward(pump, read(table::holding_registers, 0, 1));
    CHECK(f.line.take_forwarded().size() == 1);
    CHECK(f.word("D10") == 0);
}

TEST_CASE("overheard: the first polls after a takeover are spread")
{
    silent_line f;
    f.add_reads();
    f.line.fall_silent();
    f.now += 1h;
    f.line.begin_to_speak(f.now);
    const time_point begun = f.now;
    std::vector<duration> asked;
    for (int i = 0; i < 3; ++i) {
        const auto q = f.next();
        asked.push_back(f.now - begun);
        f.line.answered(q, response{exception_code::server_device_busy}, f.now, noon);
    }
    CHECK(asked == std::vector<duration>{0ms, 333'333us, 666'666us});
}
TEST_SUITE_END();
