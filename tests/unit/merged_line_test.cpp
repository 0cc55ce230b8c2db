// Routes of one station that share requests, on a line played in virtual time.
#include "tests/support/line_fixture.hpp"

#include <cstdlib>
#include <set>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr table holding = table::holding_registers;

// A device whose holding registers hold their own address, as far as it has them.
struct merged_fixture : line_fixture {
    std::set<unsigned> missing{};
    unsigned longest = 125;
    std::vector<std::pair<unsigned, unsigned>> asked{};  // first and count of each request

    void add(const char* device, std::uint16_t first, std::uint16_t count, duration period = 1s)
    {
        line.add_route(route_to(device, holding, first, count), 0, period);
    }

    response answer_to(const read_table& asks) const
    {
        if (asks.count > longest)
            return exception_code::illegal_data_value;
        registers_read read;
        for (unsigned i = number(asks.first); i < unsigned{number(asks.first)} + asks.count; ++i) {
            if (missing.contains(i))
                return exception_code::illegal_data_address;
            read.values.push_back(static_cast<std::uint16_t>(i));
        }
        return read;
    }

    void run_until(time_point end, wall_time wall = noon)
    {
        while (now < end) {
            const auto q = line.next(now);
            if (!q) {
                now = std::min(end, line.wake_at(now));
                continue;
            }
            const auto& asks = std::get<read_table>(q->request());
            asked.emplace_back(number(asks.first), asks.count);
            answer(*q, answer_to(asks), wall);
        }
    }
    std::string requests()  // since the last time, each once
    {
        std::set<std::pair<unsigned, unsigned>> once(asked.begin(), asked.end());
        asked.clear();
        std::string text;
        for (const auto& [first, count] : once)
            text += (text.empty() ? "" : " ") + std::to_string(first) + "+" + std::to_string(count);
        return text;
    }
};

}  // namespace

TEST_CASE("merged line: one answer serves all its routes, with one source time")
{
    merged_fixture f;
    f.add("D100", 10, 2);
    f.add("D200", 14, 3);
    f.add("D300", 11, 4);
    f.line.start(t0);
    const auto q = f.next();
    CHECK(q.request() == request{read_table{holding, address{10}, 7}});
    f.answer(q, registers_read{{10, 11, 12, 13, 14, 15, 16}}, noon);
    CHECK(f.word("D100") == 10);
    CHECK(f.word("D101") == 11);
    CHECK(f.word("D200") == 14);
    CHECK(f.word("D202") == 16);
    CHECK(f.word("D300") == 11);
    CHECK(f.word("D303") == 14);
    CHECK(f.word("D102") == 0);
    const auto samples = f.line.take_samples(f.now);
    REQUIRE(samples.size() == 3);  // together
    for (const sample& each : samples) {
        CHECK(each.state == quality::good);
        CHECK(each.source == noon);
    }
    CHECK(f.line.routes_up() == 3);
}

TEST_CASE("merged line: bits are cut out of the answer, too")
{
    merged_fixture f;
    f.line.add_route(f.route_to("M0", table::coils, 3, 2), 0, 1s);
    f.line.add_route(f.route_to("M100", table::coils, 20, 1), 0, 1s);
    f.line.start(t0);
    const auto q = f.next();
    CHECK(q.request() == request{read_table{table::coils, address{3}, 18}});
    bits_read answer{std::vector<bool>(18)};
    answer.values[1] = answer.values[17] = true;
    f.answer(q, answer);
    CHECK_FALSE(f.bit("M0"));
    CHECK(f.bit("M1"));
    CHECK(f.bit("M100"));
}

TEST_CASE("merged line: words of MEWTOCOL stations are merged as well")
{
    merged_fixture f;
    for (const auto& [device, from] : {std::pair{"D100", "DT5"}, std::pair{"D110", "DT10"}}) {
        route r = f.route_to(device, holding, 0, 2);
        r.there = *mewtocol::parse_device(from);
        f.line.add_route(std::move(r), 0, 1s);
    }
    f.line.start(t0);
    const auto q = f.next();
    CHECK((std::get<mewtocol::block>(q.asked) == mewtocol::block{mewtocol::read_words{mewtocol::word_area::dt, 5, 7}}));
    f.line.answered(q, mewtocol::response{mewtocol::words_read{{5, 6, 7, 8, 9, 10, 11}}}, f.now, noon);
    CHECK(f.word("D100") == 5);
    CHECK(f.word("D111") == 11);
}

TEST_CASE("merged line: silence takes all routes of the request with it")
{
    merged_fixture f;
    f.add("D100", 0, 2);
    f.add("D200", 2, 2);
    f.line.start(t0);
    f.fail(f.next());
    CHECK(f.said("D100").state == quality::comm_error);
    CHECK(f.said("D200").state == quality::comm_error);
    CHECK(f.line.take_events().empty());
}

TEST_CASE("merged line: a refused gap is learned at once, and no route notices")
{
    merged_fixture f;
    f.missing = {4};
    f.add("D100", 0, 4);
    f.add("D200", 6, 4);
    f.line.start(t0);
    f.run_until(t0 + 500ms);
    CHECK(f.requests() == "0+4 0+10 6+4");
    CHECK(f.line.routes_up() == 2);
    const auto events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].level == line_event::severity::warning);
    CHECK(events[0].text == "line bus 1, station pump (unit 5) refuses holding 0-9 in one request: exception 02 "
                            "(illegal data address); holding 4-5, wanted by no route, is left out from now on");
    CHECK(f.line.take_learned());
    CHECK_FALSE(f.line.take_learned());
    f.run_until(t0 + 1min);
    CHECK(std::abs(static_cast<int>(f.asked.size()) - 2 * 60) <= 2);  // each once a second
    CHECK(f.requests() == "0+4 6+4");
    CHECK(f.line.take_events().empty());
}

TEST_CASE("merged line: one bad register is the error of its route, never of its neighbours")
{
    merged_fixture f;
    f.missing = {9};
    f.add("D100", 0, 4);
    f.add("D110", 4, 4);
    f.add("D120", 8, 4);
    f.add("D130", 12, 4);
    f.add("D140", 16, 4);
    f.line.start(t0);
    f.run_until(t0 + 1s);
    for (const sample& each : f.line.take_samples(f.now)) {
        CAPTURE(each.route);
        CHECK(each.state == (each.route == "D120" ? quality::device_error : quality::good));
    }
    CHECK(f.word("D143") == 19);
    f.requests();
    f.run_until(t0 + 20s);
    CHECK(f.requests() == "0+8 8+4 12+8");
    f.missing.clear();
    f.run_until(t0 + 30s, wall_time{static_cast<std::int64_t>(noon) + 90'000'000'000});
    f.requests();
    f.run_until(t0 + 40s, wall_time{static_cast<std::int64_t>(noon) + 100'000'000'000});
    CHECK(f.requests() == "0+20");
    CHECK(f.line.routes_up() == 5);
}

TEST_CASE("merged line: a length limit is found, and every route keeps its period all along")
{
    merged_fixture f;
    f.longest = 32;
    constexpr const char* devices[] = {"D100", "D110", "D120", "D130", "D140", "D150", "D160", "D170", "D180", "D190"};
    for (std::uint16_t i = 0; i < 10; ++i)
        f.add(devices[i], static_cast<std::uint16_t>(10 * i), 10);
    f.line.start(t0);
    for (time_point until = t0 + 2s; until < t0 + 20s; until += 100ms) {
        f.run_until(until);
        CHECK(f.line.routes_up() == 10);
    }
    f.asked.clear();
    f.run_until(t0 + 30s);
    CHECK(f.asked.size() <= 44);  // four in a second, and where the second begins
    for (const auto& [first, count] : f.asked)
        CHECK(count <= 30);
}

TEST_CASE("merged line: what was learned before is known at the start")
{
    merged_fixture f;
    f.missing = {4};
    f.add("D100", 0, 4);
    f.add("D200", 6, 4);
    station_limits before;
    before.tables["holding"].restore({.what = learned_limit::kind::gap,
                                      .at = {4, 6},
                                      .request = {0, 10},
                                      .reason = "exception 02 (illegal data address)",
                                      .since = noon});
    f.line.remember(0, before);
    f.line.start(t0);
    f.run_until(t0 + 3s);
    CHECK(f.requests() == "0+4 6+4");
    CHECK(f.line.take_events().empty());
}

TEST_CASE("merged line: a poll that a new plan does not need leaves no station behind that is never asked again")
{
    merged_fixture f;
    f.missing = {9};
    f.add("D100", 0, 4);
    f.add("D110", 4, 4);
    f.add("D120", 8, 4);
    f.line.start(t0);
    f.run_until(t0 + 5s);
    f.missing.clear();
    f.run_until(t0 + 10s, wall_time{static_cast<std::int64_t>(noon) + 90'000'000'000});  // one poll is left over
    f.run_until(t0 + 12s);
    f.asked.clear();
    for (int i = 0; i < 2; ++i)
        f.fail(f.next());
    CHECK(f.line.routes_up() == 0);
    f.run_until(f.now + 1min);
    CHECK(f.line.routes_up() == 3);
}

TEST_CASE("merged line: merge off and the largest block of a device")
{
    for (const bool off : {true, false}) {
        merged_fixture f;
        read_settings how;
        how.merge = off ? merge_mode::off : merge_mode::automatic;
        how.max_registers = off ? 0 : 6;
        f.line = client_line("bus 1", {{"pump", unit_id{5}, patient, how}}, {.longest_silence = 10s});
        f.add("D100", 0, 2);
        f.add("D110", 2, 2);
        f.add("D120", 4, 2);
        f.add("D130", 6, 2);
        f.line.start(t0);
        f.run_until(t0 + 3s);
        CHECK(f.requests() == (off ? "0+2 2+2 4+2 6+2" : "0+4 4+4"));
    }
}

TEST_SUITE_END();
