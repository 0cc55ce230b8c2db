// Status words, missing writers, copies from PLC to PLC.
#include "bridge/routes/plc_copies.hpp"
#include "bridge/routes/route_status.hpp"
#include "bridge/routes/upstream_guards.hpp"
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr std::int64_t second = 1'000'000'000;

wall_time later(std::int64_t seconds) { return wall_time{static_cast<std::int64_t>(noon) + seconds * second}; }

std::vector<std::uint16_t> words_from(const line_fixture& f, const char* device, std::size_t count)
{
    std::vector<std::uint16_t> words(count);
    f.plc.memory().read(f.at(device), words);
    return words;
}

}  // namespace

TEST_CASE("status words: of a route and its station, as docs/points.md lists them")
{
    line_fixture f;
    f.add_reads();
    f.line.port_opened();
    status_board board(f.line);
    board.add_route(0, {&f.plc, f.at("D500"), byte_order::abcd});
    board.add_route(0, {&f.plc, f.at("D510"), byte_order::cdab});
    board.add_station(0, {&f.plc, f.at("D520"), {}});
    using words = std::vector<std::uint16_t>;
    board.show(noon);
    CHECK(words_from(f, "D500", 8) == words{0, 0, 65535, 0, 0, 0, 0, 0});
    CHECK(words_from(f, "D520", 4) == words{0, 2, 0, 65535});

    f.answer(f.next(), modbus::registers_read{{1, 2}});
    board.show(later(7));
    constexpr std::uint16_t high = 1'700'000'000 >> 16;
    constexpr std::uint16_t low = 1'700'000'000 & 0xFFFF;
    CHECK(words_from(f, "D500", 8) == words{192, 0, 7, high, low, 0, 1, 0});
    CHECK(words_from(f, "D510", 8) == words{192, 0, 7, low, high, 0, 1, 0});
    CHECK(words_from(f, "D520", 4) == words{0, 2, 1, 7});
    board.show(later(1'000'000));
    CHECK(f.word("D502") == 65535);

    for (int i = 0; i < 8; ++i) {
        const auto q = f.next();
        if (number(q.unit) == 5 && q.request() == modbus::request{modbus::read_table{modbus::table::holding_registers,
                                                                                     modbus::address{0x10}, 2}})
            f.answer(q, modbus::exception_code::illegal_data_address);
        else
            f.answer(q, q.unit == station_number(modbus::unit_id{6})
                            ? modbus::response{modbus::bits_read{{true, false, true}}}
                            : modbus::response{modbus::registers_read{{1}}});
    }
    board.show(later(8));
    CHECK(f.word("D500") == 12);
    CHECK(f.word("D501") == 2);

    f.line.port_lost("unplugged");
    board.show(later(9));
    CHECK(f.word("D500") == 24);
    CHECK(f.word("D501") == 0x106);
}

TEST_CASE("status words: a station that falls silent")
{
    line_fixture f;
    f.line.add_route(f.route_to("D100", modbus::table::holding_registers, 0, 1), 0, 1s);
    f.line.port_opened();
    f.line.start(t0);
    status_board board(f.line);
    board.add_route(0, {&f.plc, f.at("D500"), {}});
    f.fail(f.next());
    board.show(noon);
    CHECK(f.word("D501") == 0x101);
    CHECK(f.word("D505") == 1);
    CHECK(f.word("D507") == 1);  // suspect
    f.fail(f.next(), errc::bad_checksum);
    board.show(noon);
    CHECK(f.word("D501") == 0x102);
    CHECK(f.word("D507") == 2);  // down
}

TEST_CASE("upstream: safe values when nobody writes, also when nobody ever wrote; the next write ends it")
{
    fx3u_fixture f;
    upstream_guards guards;
    guards.add({"pump.set", &f.plc, f.at("D100"), 32, 5s, {0, 50}});
    guards.start(t0);
    CHECK(guards.wake_at() == t0 + 5s);
    f.set("D100", 1);
    guards.written(t0 + 1s);
    CHECK(guards.wake_at() == t0 + 6s);
    f.set("D100", 1);  // the same value is a sign of life
    guards.written(t0 + 4s);
    f.set("D102", 1);  // beside it
    guards.written(t0 + 8s);
    guards.look(t0 + 8999ms);
    CHECK(f.word("D100") == 1);
    CHECK(guards.take_events().empty());

    guards.look(t0 + 9s);
    CHECK(f.word("D100") == 0);
    CHECK(f.word("D101") == 50);
    CHECK(guards.wake_at() == time_point::max());
    auto events = guards.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text == "route pump.set: nobody wrote its devices for 5 s, the safe values go to the station");
    guards.written(t0 + 10s);  // what the guard wrote itself is no sign of life
    guards.look(t0 + 20s);
    CHECK(guards.take_events().empty());

    f.set("D101", 7);
    guards.written(t0 + 21s);
    events = guards.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text == "route pump.set: its devices are written again, no more safe values");
    CHECK(guards.wake_at() == t0 + 26s);
}

TEST_CASE("upstream: bits, to the bit")
{
    fx3u_fixture f;
    upstream_guards guards;
    guards.add({"valves", &f.plc, f.at("M3"), 3, 1s, {0b101}});
    guards.start(t0);
    f.set_bit("M2", true);
    f.set_bit("M6", true);
    guards.written(t0);
    guards.look(t0 + 1s);
    CHECK(f.bit("M3"));
    CHECK_FALSE(f.bit("M4"));
    CHECK(f.bit("M5"));
    CHECK(f.bit("M2"));
    CHECK(f.bit("M6"));
}

TEST_CASE("copies: a change goes on to the other PLC, to the same place and no further")
{
    fx3u_fixture f;
    plc::simulated_plc other{"other", plc::fx3u, {}};
    other.memory().take_changes();
    const auto there = [&](const char* device) { return *other.memory().find(*plc::parse_device(device)); };
    plc_copies copies;
    copies.add({"out", &f.plc, f.at("D100"), &other, there("D10"), 64});
    copies.add({"back", &other, there("D10"), &f.plc, f.at("D100"), 64});
    copies.add({"bits", &f.plc, f.at("M3"), &other, there("M100"), 20});
    const auto settle = [&] {
        int rounds = 0;
        for (bool changed = true; changed; ++rounds) {
            changed = false;
            for (plc::simulated_plc* each : {&f.plc, &other})
                for (const plc::change& what : each->memory().take_changes()) {
                    changed = true;
                    copies.memory_changed(*each, what);
                }
        }
        return rounds;
    };
    f.set("D99", 1);
    f.set("D101", 2);
    f.set("D103", 4);
    f.set_bit("M22", true);
    f.set_bit("M23", true);
    CHECK(settle() <= 3);
    CHECK(other.memory().word(there("D11")) == 2);
    CHECK(other.memory().word(there("D13")) == 4);
    CHECK(other.memory().word(there("D14")) == 0);
    CHECK(other.memory().bit(there("M119")));
    CHECK_FALSE(other.memory().bit(there("M120")));
    other.memory().set_word(there("D12"), 9);
    CHECK(settle() <= 3);
    CHECK(f.word("D102") == 9);
}

TEST_CASE("memory: writes are seen by who watches the devices, also of the same value")
{
    fx3u_fixture f;
    const auto first = f.plc.memory().watch_writes(f.at("D100"), 32);
    const auto second = f.plc.memory().watch_writes(f.at("D101"), 16);
    f.set("D99", 1);
    CHECK_FALSE(f.plc.memory().take_written());
    f.set("D101", 0);
    CHECK(f.plc.memory().take_written());
    CHECK_FALSE(f.plc.memory().take_written());
    CHECK(f.plc.memory().take_written(first));
    CHECK(f.plc.memory().take_written(second));
    CHECK_FALSE(f.plc.memory().take_written(second));
    f.plc.memory().put_word(f.at("D101"), 5);
    CHECK(f.word("D101") == 5);
    CHECK_FALSE(f.plc.memory().take_written(first));
}

TEST_SUITE_END();
