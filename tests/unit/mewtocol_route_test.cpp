// Routes whose stations speak MEWTOCOL, on a line played in virtual time.
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

using values = std::vector<std::uint16_t>;

struct mewtocol_fixture : line_fixture {
    route from(const char* source, const char* device, std::uint16_t count, direction way = direction::read)
    {
        route r = route_to(device, modbus::table::holding_registers, 0, count, way);
        r.there = *parse_device(source);
        return r;
    }
    static block asked(const client_line::question& q) { return std::get<block>(q.asked); }
    void answer(const client_line::question& q, const response& with)
    {
        now += 20ms;
        line.answered(q, with, now, noon);
    }
};

}  // namespace

TEST_CASE("mewtocol route: words and contacts are read into devices, and said under the station's names")
{
    mewtocol_fixture f;
    f.line.add_route(f.from("DT100", "D100", 2), 0, 1s);
    f.line.start(t0);
    const auto q = f.next();
    CHECK(number(q.unit) == 5);
    CHECK((f.asked(q) == block{read_words{word_area::dt, 100, 2}}));
    f.answer(q, words_read{{7, 8}});
    CHECK(f.word("D100") == 7);
    CHECK(f.word("D101") == 8);
    const sample& said = f.said("D100");
    CHECK(said.area == "DT");
    CHECK(said.first == 100);
    CHECK(said.format == sample_format::words);
    CHECK(said.words == values{7, 8});
    CHECK(said.state == quality::good);
}

TEST_CASE("mewtocol route: contacts are bits, numbered by their point")
{
    mewtocol_fixture f;
    f.line.add_route(f.from("R1F", "M100", 3), 0, 1s);
    f.line.start(t0);
    const auto q = f.next();
    CHECK((f.asked(q) == block{read_run{{contact_area::internal_relay, 31}, 3}}));
    f.answer(q, contacts_read{{true, false, true}});
    CHECK(f.bit("M100"));
    CHECK_FALSE(f.bit("M101"));
    CHECK(f.bit("M102"));
    const sample& said = f.said("M100");
    CHECK(said.area == "R");
    CHECK(said.first == 31);
    CHECK(said.format == sample_format::bits);
    CHECK(said.count == 3);
    CHECK(said.words == values{5});
}

TEST_CASE("mewtocol route: a write carries what the memory holds, to the global station too")
{
    for (const bool global : {false, true}) {
        mewtocol_fixture f;
        f.line.add_route(f.from("DT5", "D100", 2, direction::write), 0, {});
        f.line.add_route(f.from("Y10", "M0", 2, direction::write), 0, {});
        f.line.start(t0);
        f.set("D101", 9);
        f.set_bit("M1", true);
        CHECK(f.memory_changed());
        const response taken = global ? response{no_response{}} : response{executed{}};
        for (int i = 0; i < 2; ++i) {
            const auto q = f.next();
            if (std::holds_alternative<write_words>(f.asked(q)))
                CHECK((f.asked(q) == block{write_words{word_area::dt, 5, {0, 9}}}));
            else
                CHECK((f.asked(q) == block{write_run{{contact_area::external_output, 16}, {false, true}}}));
            f.answer(q, taken);
        }
        CHECK(f.said("D100").words == values{0, 9});
        CHECK(f.said("M0").words == values{2});
        CHECK(f.said("M0").state == quality::good);
    }
}

TEST_CASE("mewtocol route: an error code is the quality, its text and the result code of RECV are the reason")
{
    mewtocol_fixture f;
    f.line.add_route(f.from("DT65535", "D100", 1), 0, 1s);
    f.line.start(t0);
    f.answer(f.next(), error_code::data);
    CHECK(f.said("D100").state == quality::device_error);
    const auto events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text ==
          "line bus 1, route D100: line bus 1, station pump (unit 5) refuses: error 61 (data), result 6");
    f.answer(f.next(), words_read{{1}});
    CHECK(f.said("D100").state == quality::good);
}

TEST_CASE("mewtocol route: a write to a busy station goes out again, one refused for good waits for a change")
{
    mewtocol_fixture f;
    f.line.add_route(f.from("DT5", "D100", 1, direction::write), 0, {});
    f.line.start(t0);
    f.set("D100", 9);
    f.memory_changed();
    f.answer(f.next(), error_code::busy);
    CHECK_FALSE(f.line.next(f.now).has_value());
    f.now += 1s;
    f.answer(f.next(), error_code::protection);
    CHECK_FALSE(f.line.next(f.now + 1h).has_value());
}

TEST_CASE("mewtocol route: who writes through hears a refusal as an exception of MODBUS")
{
    mewtocol_fixture f;
    f.line.add_route(f.from("DT5", "D100", 2, direction::write_through), 0, {});
    f.line.port_opened();
    f.line.start(t0);
    f.set("D100", 9);
    f.line.write_through(f.plc);
    f.answer(f.next(), error_code::data);
    const auto outcomes = f.line.take_through();
    REQUIRE(outcomes.size() == 1);
    CHECK(outcomes.front().failed == modbus::exception_code::illegal_data_address);
}

TEST_CASE("mewtocol route: a silent station is result 5, a damaged answer 6, a busy line 4")
{
    const struct {
        errc why;
        const char* result;
    } rows[] = {
        {errc::timed_out, ", result 5"}, {errc::bad_checksum, ", result 6"}, {errc::line_not_quiet, ", result 4"}};
    for (const auto& row : rows) {
        mewtocol_fixture f;
        f.line.add_route(f.from("DT5", "D100", 1), 0, 1s);
        f.line.start(t0);
        const auto q = f.next();
        const std::string reason = reason_of(q.asked, make_error_code(row.why));
        CHECK_MESSAGE(reason.ends_with(row.result), reason);
        f.fail(q, row.why);
        CHECK(f.said("D100").state == quality::comm_error);
    }
    mewtocol_fixture f;
    f.line.add_route(f.from("DT5", "D100", 1), 0, 1s);
    f.line.start(t0);
    f.fail(f.next());
    f.fail(f.next());
    const auto events = f.line.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].text.find(", result 5): its values are kept") != std::string::npos);
}

TEST_SUITE_END();
