// A transaction on a well-behaved line: gaps, deadlines, retries and broadcasts, to the microsecond.
#include "tests/support/rtu_script.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

const unit_id unit{0x11};
const request question = read_table{table::holding_registers, address{0x6B}, 3};
const buffer asked{0x11, 0x03, 0x00, 0x6B, 0x00, 0x03, 0x76, 0x87};
const buffer answer{0x11, 0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40, 0x49, 0xAD};
const response values = registers_read{{0xAE41, 0x5652, 0x4340}};

constexpr duration on_wire = 4'584us;  // 8 characters of 11 bits at 19200 bit/s
constexpr duration gap = 2'006us;      // 3.5 characters

constexpr serial_options timing{.format = {}, .response_timeout = 500ms, .retries = 1};

}  // namespace

TEST_CASE("serial transaction: an answer ends it at once")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    CHECK(waits(t, t0) == t0 + on_wire + 500ms);

    t.feed(t0 + 20ms, answer);
    REQUIRE(is_done(t, t0 + 20ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 1);
    CHECK(t.response_time() == 20ms - on_wire);
    CHECK(t.line_free_from() == t0 + 20ms + gap);
    CHECK(t.stray_bytes() == 0);
}

TEST_CASE("serial transaction: an answer in pieces ends it with the last piece, each piece extends the wait")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    for (std::size_t i = 0; i < answer.size(); ++i) {
        const time_point now = t0 + 20ms + i * 15ms;
        t.feed(now, bytes(answer).subspan(i, 1));
        if (i < 2)  // so far it may be the echo of the request
            CHECK(waits(t, now) == t0 + on_wire + timing.response_timeout);
        else if (i + 1 < answer.size())
            CHECK(waits(t, now) == now + timing.silence);
        else
            CHECK(is_done(t, now));
    }
    CHECK(t.outcome().value() == values);
}

TEST_CASE("serial transaction: an exception is an answer and is not asked again")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 20ms, encode_rtu({unit, {0x83, 0x02}}));
    REQUIRE(is_done(t, t0 + 20ms));
    CHECK(t.outcome().value() == response{exception_code::illegal_data_address});
    CHECK(t.attempts() == 1);
}

TEST_CASE("serial transaction: the deadline counts from the end of the request on the wire")
{
    serial_options slow = timing;
    slow.format = {.baud_rate = 1200};
    serial_transaction t(unit, question, slow, t0, t0);
    REQUIRE(sends(t, t0, asked));
    CHECK(waits(t, t0) == t0 + 73'334us + 500ms);
    CHECK(waits(t, t0 + 573'333us) == t0 + 573'334us);
    CHECK(sends(t, t0 + 573'334us, asked));
}

TEST_CASE("serial transaction: silence is answered by as many retries as are allowed, then by a failure")
{
    for (unsigned retries = 0; retries <= 3; ++retries) {
        CAPTURE(retries);
        serial_options allowed = timing;
        allowed.retries = retries;
        serial_transaction t(unit, question, allowed, t0, t0);

        time_point now = t0;
        for (unsigned attempt = 0; attempt <= retries; ++attempt) {
            REQUIRE(sends(t, now, asked));
            now += on_wire + 500ms;
            CHECK(waits(t, now - 1us) == now);
        }
        REQUIRE(is_done(t, now));
        CHECK(t.outcome().error() == errc::timed_out);
        CHECK(t.attempts() == retries + 1);
        CHECK(t.line_free_from() <= now);  // it has been silent for long
    }
}

TEST_CASE("serial transaction: an answer to a retry")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    const time_point second = t0 + on_wire + 500ms;
    REQUIRE(sends(t, second, asked));
    t.feed(second + 30ms, answer);
    REQUIRE(is_done(t, second + 30ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 2);
    CHECK(t.response_time() == 30ms - on_wire);
}

TEST_CASE("serial transaction: it waits until the line is free")
{
    serial_transaction t(unit, question, timing, t0 + gap, t0);
    CHECK(waits(t, t0) == t0 + gap);
    CHECK(waits(t, t0 + gap - 1us) == t0 + gap);
    CHECK(sends(t, t0 + gap, asked));
}

TEST_CASE("serial transaction: the gap is 3.5 characters, 1750 us above 19200 bit/s, or longer where configured")
{
    struct {
        const char* name;
        unsigned baud_rate;
        duration configured;
        duration expected;
    } const gaps[] = {
        {"9600", 9600, 0us, 4'011us},
        {"19200", 19200, 0us, 2'006us},
        {"38400", 38400, 0us, 1'750us},
        {"115200", 115200, 0us, 1'750us},
        {"a shorter one is not believed", 19200, 1ms, 2'006us},
        {"a longer one for a slow station", 19200, 10ms, 10ms},
    };
    for (const auto& row : gaps) {
        CAPTURE(row.name);
        serial_options with_gap = timing;
        with_gap.format.baud_rate = row.baud_rate;
        with_gap.gap = row.configured;
        serial_transaction t(unit, question, with_gap, t0, t0);
        REQUIRE(sends(t, t0, asked));
        t.feed(t0 + 30ms, bytes(answer).first(5));
        t.feed(t0 + 40ms, bytes(answer).subspan(5));
        REQUIRE(is_done(t, t0 + 40ms));
        CHECK(t.line_free_from() == t0 + 40ms + row.expected);  // from the last byte heard
    }
}

TEST_CASE("serial transaction: a broadcast is not answered, the stations get their turnaround delay")
{
    const request all_off = write_multiple_coils{address{0}, std::vector<bool>(8)};
    const buffer adu{0x00, 0x0F, 0x00, 0x00, 0x00, 0x08, 0x01, 0x00, 0x3F, 0x59};
    const duration broadcast_on_wire = 5'730us;

    serial_transaction t(unit_id::broadcast, all_off, timing, t0, t0);
    REQUIRE(encode_rtu({unit_id::broadcast, encode_request(all_off)}) == adu);
    REQUIRE(sends(t, t0, adu));
    REQUIRE(is_done(t, t0));
    CHECK(t.outcome().value() == response{no_response{}});
    CHECK(t.line_free_from() == t0 + broadcast_on_wire + 100ms);

    serial_options hasty = timing;
    hasty.turnaround = 1ms;  // FX3 manual 6.1, D8410 note 2: 3.5 characters at least
    serial_transaction short_delay(unit_id::broadcast, all_off, hasty, t0, t0);
    REQUIRE(sends(short_delay, t0, adu));
    CHECK(short_delay.line_free_from() == t0 + broadcast_on_wire + gap);
}

TEST_CASE("serial transaction: an answer that was read late, but before anybody asked, still counts")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 700ms, answer);
    REQUIRE(is_done(t, t0 + 700ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 1);
}

TEST_SUITE_END();
