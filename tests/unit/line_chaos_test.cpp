// A line on which everything happens at once: polls, writes of all directions, forwarded requests and clients that
// leave, stations that fall silent, say that they are busy, or do what they are told and lose the answer, and a port
// that comes and goes. When it is quiet again, everything is as it should be, and nobody was forgotten.
#include "tests/support/line_fixture.hpp"

#include <random>
#include <set>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr unsigned stations = 5;  // the last one has no routes

// Holding registers of a station; it may be away.
struct field_station {
    std::array<std::uint16_t, 64> registers{};
    bool is_there = true;

    response execute(const request& asked)
    {
        if (const auto* const read = std::get_if<read_table>(&asked)) {
            const auto first = registers.begin() + number(read->first);
            return registers_read{std::vector<std::uint16_t>(first, first + read->count)};
        }
        if (const auto* const one = std::get_if<write_single_register>(&asked))
            registers.at(number(one->at)) = one->value;
        else if (const auto* const some = std::get_if<write_multiple_registers>(&asked))
            std::copy(some->values.begin(), some->values.end(), registers.begin() + number(some->first));
        return written{};
    }
};

struct chaos : fx3u_fixture {
    explicit chaos(unsigned seed, unsigned parallel)
        : random(seed),
          line("bus",
               {{"a", unit_id{1}, hasty}, {"b", unit_id{2}, hasty}, {"c", unit_id{3}, hasty}, {"d", unit_id{4}, hasty}},
               {.longest_silence = 10s, .cache_age = 200ms, .parallel = parallel})
    {
        const auto add = [&](const char* device, std::uint16_t first, std::uint16_t count, std::size_t station,
                             direction way, duration period) {
            line.add_route(route_to(device, table::holding_registers, first, count, way), station, period);
        };
        add("D100", 0, 4, 0, direction::read, 500ms);
        add("D110", 10, 2, 0, direction::read_write, 1s);
        add("D120", 20, 2, 0, direction::write, {});
        add("D130", 0, 2, 1, direction::write_through, {});
        add("D140", 5, 1, 1, direction::read, 1s);
        add("D150", 30, 1, 1, direction::periodic_write, 2s);
        add("D160", 0, 1, 2, direction::write_through, {});
        add("D170", 0, 1, 3, direction::write, {});
        line.port_opened();
        line.start(now);
        most = parallel;
    }

    std::size_t below(std::size_t n) { return random() % n; }
    bool one_in(std::size_t n) { return below(n) == 0; }

    void settle()
    {
        for (const auto& each : line.take_through()) {
            CHECK(through_waits.erase(each.number) == 1);
            through_failed += each.failed ? 1 : 0;
        }
        for (const forward_answer& each : line.take_forwarded())
            CHECK(forwards_wait.erase(each.ticket) == 1);
        for (int round = 0; round < 3; ++round) {
            if (plc.memory().take_written())
                line.memory_written();
            for (const plc::change& each : plc.memory().take_changes())
                line.memory_changed(plc, each);
        }
        line.take_samples(now);
        line.take_events();
    }

    void something_happens()
    {
        const auto value = static_cast<std::uint16_t>(below(3));  // often one that it had before
        constexpr const char* programs[] = {"D110", "D111", "D120", "D121", "D150", "D170"};
        constexpr const char* clients[] = {"D130", "D131", "D160"};
        switch (below(8)) {
        case 0: set(programs[below(6)], value); break;
        case 1:
            set(clients[below(3)], value);
            for (const std::uint64_t each : line.write_through(plc))
                through_waits.insert(each);
            break;
        case 2:
        case 3: {
            const auto at = static_cast<std::uint16_t>(40 + below(10));
            const request asked = one_in(4) ? request{write_single_register{address{at}, value}}
                                            : request{read_table{table::holding_registers, address{at}, 3}};
            const auto ticket = line.forward(unit_id{static_cast<std::uint8_t>(1 + below(stations))}, asked, {},
                                             forward_asker{1 + below(4)});
            if (ticket)
                forwards_wait.insert(*ticket);
            line.look_at_forwarded(now);
            break;
        }
        case 4:
            if (!forwards_wait.empty()) {
                line.cancel(*forwards_wait.begin());
                forwards_wait.erase(forwards_wait.begin());
            }
            break;
        case 5: field[below(stations)].is_there = !one_in(2); break;
        case 6:
            if (one_in(20))
                port_comes_and_goes();
            break;
        default: field[0].registers[below(4)] = value;
        }
        settle();
    }

    void port_comes_and_goes()
    {
        for (const client_line::question& each : under_way)
            line.interrupted(each);
        under_way.clear();
        line.port_lost("unplugged");
        settle();
        CHECK(through_waits.empty());
        CHECK(forwards_wait.empty());
        now += 100ms;
        line.port_opened();
    }

    void end(const client_line::question& q, bool is_calm)
    {
        field_station& to = field[number(q.unit) - 1];
        if (!to.is_there || (!is_calm && one_in(10))) {
            if (to.is_there && one_in(2))
                to.execute(q.request());  // and the answer is lost
            now += 200ms;
            line.failed(q, make_error_code(errc::timed_out), now, {1, now - 200ms});
        }
        else if (!is_calm && one_in(15)) {
            now += 5ms;
            line.answered(q, exception_code::server_device_busy, now, noon);
        }
        else {
            const response said = to.execute(q.request());
            now += 10ms;
            line.answered(q, said, now, noon);
        }
        settle();
    }

    void play(time_point until, bool is_calm)
    {
        while (now < until) {
            if (!is_calm && one_in(3))
                something_happens();
            while (under_way.size() < most) {
                auto q = line.next(now);
                if (!q)
                    break;
                under_way.push_back(std::move(*q));
            }
            settle();
            if (!under_way.empty()) {
                const std::size_t which = below(under_way.size());
                const client_line::question q = std::move(under_way[which]);
                under_way.erase(under_way.begin() + static_cast<std::ptrdiff_t>(which));
                end(q, is_calm);
                continue;
            }
            const time_point wake = line.wake_at(now);
            REQUIRE(wake > now);  // else the line would spin
            now = std::min({wake, until, is_calm ? time_point::max() : now + 50ms});
        }
    }

    std::mt19937 random;
    client_line line;
    std::size_t most = 1;
    std::array<field_station, stations> field{};
    std::vector<client_line::question> under_way;
    std::set<std::uint64_t> through_waits;
    std::set<forward_ticket> forwards_wait;
    unsigned through_failed = 0;
    time_point now = t0;
};

}  // namespace

TEST_CASE("line: after minutes of everything at once it is as it was meant to be")
{
    for (const unsigned parallel : {1U, 4U})
        for (unsigned seed = 1; seed <= 3; ++seed) {
            CAPTURE(seed);
            CAPTURE(parallel);
            chaos c(seed, parallel);
            c.play(t0 + 5min, false);
            CHECK(c.through_failed > 0);
            for (field_station& each : c.field)
                each.is_there = true;
            c.play(c.now + 3min, true);

            CHECK(c.through_waits.empty());
            CHECK(c.forwards_wait.empty());
            for (std::size_t station = 0; station < 4; ++station) {
                CAPTURE(station);
                CHECK(c.line.health_of(station) != health::down);
                if (station < 2)  // of those that nobody polls the next write tells
                    CHECK(c.line.health_of(station) == health::healthy);
            }
            const auto has = [&](unsigned station, unsigned first, const char* device) {
                CAPTURE(device);
                CHECK(c.field[station].registers[first] == c.word(device));
            };
            has(0, 0, "D100");
            has(0, 3, "D103");
            has(0, 10, "D110");
            has(0, 11, "D111");
            has(0, 20, "D120");
            has(0, 21, "D121");
            has(1, 5, "D140");
            has(1, 30, "D150");
            has(3, 0, "D170");
            for (std::size_t row = 0; row < c.line.rows(); ++row) {
                CAPTURE(c.line.route_at(row).name);
                if (reads(c.line.route_at(row).way))
                    CHECK(c.line.route_at(row).state == quality::good);
            }
        }
}

TEST_SUITE_END();
