// The routes of a line whose stations a standby cannot hear: it knows what the active member says.
#include "bridge/standby/pair_mirror.hpp"
#include "tests/support/line_fixture.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

struct mirrored_line : line_fixture {
    std::size_t add(const char* device, direction way, std::uint16_t count = 1)
    {
        const std::size_t row = line.add_route(route_to(device, table::holding_registers, 7, count, way), 0, 1s);
        line.start(t0);
        line.fall_silent();
        return row;
    }
    // The active member's memory.
    void bring(const char* device, std::uint16_t value)
    {
        set(device, value);
        memory_changed();
    }
    void record(std::size_t row, std::uint32_t answers, std::vector<std::uint16_t> words, quality state = quality::good)
    {
        line.adopt(row,
                   {line.route_at(row).name, line.is_half(row), 1, state, wall_time{1}, 7, answers, 3, "why", words},
                   now, noon);
        memory_changed();
    }
    std::optional<request> written_after_takeover()
    {
        line.forget_written();
        line.begin_to_speak(now);
        for (const time_point end = now + 900ms; now < end; now = std::max(now + 1ms, line.wake_at(now))) {
            const auto q = line.next(now);
            if (q && !std::holds_alternative<read_table>(q->request()))
                return q->request();
            if (q)
                line.answered(*q, response{exception_code::server_device_busy}, now, noon);
        }
        return std::nullopt;
    }
};

}  // namespace

TEST_CASE_FIXTURE(mirrored_line, "mirrored line: a value that was read elsewhere is as old and as good as there")
{
    const std::size_t row = add("D100", direction::read);
    bring("D100", 42);
    record(row, 5, {42}, quality::device_error);
    const sample said_now = said(line.route_at(row).name.c_str());
    CHECK(said_now.words == std::vector<std::uint16_t>{42});
    CHECK(said_now.state == quality::device_error);
    CHECK(said_now.source == wall_time{1});
    CHECK(line.route_at(row).answers == 5);
    CHECK(line.route_at(row).errors == 3);
    CHECK(line.route_at(row).reason == "why");
    record(row, 6, {42}, quality::good);
    CHECK(said(line.route_at(row).name.c_str()).state == quality::stale);  // it is of 1970
    CHECK_FALSE(written_after_takeover());
}

TEST_CASE_FIXTURE(mirrored_line, "mirrored line: what was written elsewhere is not written again, what was not is")
{
    for (const direction way : {direction::write, direction::write_through}) {
        CAPTURE(static_cast<int>(way));
        mirrored_line each;
        const std::size_t row = each.add("D100", way);
        SUBCASE("written and answered")
        {
            each.bring("D100", 42);
            each.record(row, 1, {42});
            CHECK_FALSE(each.written_after_takeover());
        }
        SUBCASE("the record comes before the memory")
        {
            each.record(row, 1, {42});
            each.bring("D100", 42);
            CHECK_FALSE(each.written_after_takeover());
        }
        SUBCASE("never written")
        {
            each.record(row, 0, {0}, quality::never_read);
            each.bring("D100", 42);
            const auto written = each.written_after_takeover();
            REQUIRE(written);
            CHECK(*written == request{write_single_register{address{7}, 42}});
        }
        SUBCASE("written, and changed again")
        {
            each.bring("D100", 42);
            each.record(row, 1, {42});
            each.bring("D100", 43);
            const auto written = each.written_after_takeover();
            REQUIRE(written);
            CHECK(*written == request{write_single_register{address{7}, 43}});
        }
        SUBCASE("failed there, and taken back")
        {
            each.bring("D100", 42);
            each.record(row, 1, {42});
            each.bring("D100", 43);
            each.bring("D100", 42);
            CHECK_FALSE(each.written_after_takeover());
        }
    }
}

TEST_CASE_FIXTURE(mirrored_line, "mirrored line: a route that reads and writes is not written because of what was read")
{
    const std::size_t row = add("D100", direction::read_write);
    SUBCASE("read there")
    {
        bring("D100", 42);
        record(row, 1, {42});
        CHECK_FALSE(written_after_takeover());
    }
    SUBCASE("written by a client there, and not sent")
    {
        bring("D100", 42);
        record(row, 1, {42});
        bring("D100", 43);
        const auto written = written_after_takeover();
        REQUIRE(written);
        CHECK(*written == request{write_single_register{address{7}, 43}});
    }
    SUBCASE("written there")
    {
        bring("D100", 43);
        record(row + 1, 1, {43});
        record(row, 2, {43});
        CHECK_FALSE(written_after_takeover());
    }
}

TEST_CASE_FIXTURE(mirrored_line, "mirrored line: a record of another shape is passed over")
{
    const std::size_t row = add("D100", direction::read, 2);
    record(row, 5, {42});
    CHECK(line.route_at(row).answers == 0);
}

TEST_SUITE_END();
