// A transaction on a bad line: stray bytes, damage, strangers, late answers, babble.
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
const buffer noise{0xFF};

constexpr duration on_wire = 4'584us;
constexpr duration gap = 2'006us;
constexpr duration silence = 20ms;

constexpr serial_options timing{.format = {}, .response_timeout = 500ms, .retries = 1, .silence = silence};

buffer damaged(buffer adu)
{
    adu[4] = static_cast<std::uint8_t>(adu[4] ^ 0x01);
    return adu;
}

}  // namespace

TEST_CASE("serial transaction: stray bytes before the request postpone it by a gap each")
{
    serial_transaction t(unit, question, timing, t0 + gap, t0);
    t.feed(t0 + 1ms, noise);
    CHECK(waits(t, t0 + 1ms) == t0 + 1ms + gap);
    t.feed(t0 + 2ms, buffer{0x00, 0x00});
    CHECK(waits(t, t0 + gap) == t0 + 2ms + gap);
    CHECK(sends(t, t0 + 2ms + gap, asked));
    CHECK(t.stray_bytes() == 3);
}

TEST_CASE("serial transaction: a line that never falls silent is reported and not talked over")
{
    serial_transaction t(unit, question, timing, t0, t0);
    time_point now = t0;
    for (; now < t0 + 500ms; now += 1ms) {
        t.feed(now, noise);
        const auto until = waits(t, now);
        REQUIRE(until.has_value());
        CHECK(*until > now);
        CHECK(*until <= t0 + 500ms);
    }
    t.feed(now, noise);
    REQUIRE(is_done(t, now));
    CHECK(t.outcome().error() == errc::line_not_quiet);
    CHECK(t.attempts() == 0);
    CHECK(t.line_free_from() == now + gap);
}

TEST_CASE(
    "serial transaction: a damaged answer fails after the silence, not after the response timeout, and is retried")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 30ms, damaged(answer));
    CHECK(waits(t, t0 + 30ms) == t0 + 30ms + silence);
    REQUIRE(sends(t, t0 + 30ms + silence, asked));
    t.feed(t0 + 80ms, answer);
    REQUIRE(is_done(t, t0 + 80ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 2);
    CHECK(t.line_free_from() == t0 + 80ms + gap);  // nobody owes us a second answer
}

TEST_CASE("serial transaction: a retry keeps the gap as well, where that is longer than the silence")
{
    serial_options careful = timing;
    careful.gap = 50ms;
    serial_transaction t(unit, question, careful, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 30ms, damaged(answer));
    CHECK(waits(t, t0 + 30ms + silence) == t0 + 80ms);
    CHECK(sends(t, t0 + 80ms, asked));
}

TEST_CASE("serial transaction: the last attempt says what was wrong")
{
    struct {
        const char* name;
        buffer received;
        errc why;
    } const answers[] = {
        {"damaged", damaged(answer), errc::bad_checksum},
        {"cut short", buffer(answer.begin(), answer.begin() + 7), errc::incomplete},
        {"two registers instead of three", encode_rtu({unit, {0x03, 0x04, 1, 2, 3, 4}}), errc::unexpected_answer},
    };
    serial_options once = timing;
    once.retries = 0;
    for (const auto& row : answers) {
        CAPTURE(row.name);
        serial_transaction t(unit, question, once, t0, t0);
        REQUIRE(sends(t, t0, asked));
        t.feed(t0 + 30ms, row.received);
        REQUIRE(is_done(t, t0 + 30ms + silence));
        CHECK(t.outcome().error() == row.why);
        CHECK(t.attempts() == 1);
    }
}

// V1.02 section 2.4.1: "In case of a reply received from an unexpected slave, the Response time-out is kept running."
TEST_CASE("serial transaction: what cannot be our station's answer leaves the response timeout running")
{
    struct {
        const char* name;
        buffer heard;
    } const rows[] = {
        {"a late answer of another station", encode_rtu({unit_id{0x12}, {0x03, 0x06, 1, 2, 3, 4, 5, 6}})},
        {"00 of a transceiver that turns round", {0x00}},
        {"FF of a transceiver that turns round", {0xFF}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        serial_transaction t(unit, question, timing, t0, t0);
        REQUIRE(sends(t, t0, asked));
        t.feed(t0 + 5ms, row.heard);
        CHECK(
            waits(t, t0 + 5ms + silence).has_value());  // and does not ask again while our station prepares its answer
        t.feed(t0 + 300ms, answer);
        REQUIRE(is_done(t, t0 + 300ms));
        CHECK(t.outcome().value() == values);
        CHECK(t.attempts() == 1);
    }
}

TEST_CASE("serial transaction: a stranger's frame instead of an answer does not make the timeout longer")
{
    serial_options once = timing;
    once.retries = 0;
    serial_transaction t(unit, question, once, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 5ms, encode_rtu({unit_id{0x12}, {0x83, 0x02}}));
    REQUIRE(is_done(t, t0 + on_wire + 500ms));
    CHECK(t.outcome().has_error());
}

TEST_CASE("serial transaction: a late answer to the first attempt is taken, and the second is still owed")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    const time_point first_end = t0 + on_wire;
    REQUIRE(sends(t, first_end + 500ms, asked));

    // The station takes 600 ms for every answer.
    t.feed(first_end + 600ms, answer);
    REQUIRE(is_done(t, first_end + 600ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.unanswered() == 1);
    CHECK(t.unanswered_since() == first_end);
    CHECK(t.line_free_from() == first_end + 600ms + gap);  // for other stations: the schedule holds this one back
}

TEST_CASE("serial transaction: the echo of a read is left out, and does not end the wait for the answer")
{
    serial_transaction t(unit, question, timing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 5ms, asked);
    CHECK(waits(t, t0 + 300ms) == t0 + on_wire + 500ms);
    CHECK(t.echo_seen());
    t.feed(t0 + 300ms, answer);
    REQUIRE(is_done(t, t0 + 300ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.unanswered() == 0);
}

TEST_CASE("serial transaction: on a line with echo, the echo of a write is no answer")
{
    const request write = write_single_register{address{7}, 1234};
    const buffer adu = encode_rtu({unit, encode_request(write)});
    serial_options echoing = timing;
    echoing.echo = local_echo::on;
    echoing.retries = 0;

    serial_transaction dead(unit, write, echoing, t0, t0);
    REQUIRE(sends(dead, t0, adu));
    dead.feed(t0 + 5ms, adu);
    REQUIRE(is_done(dead, t0 + 1s));
    CHECK(dead.outcome().error() == errc::timed_out);

    serial_transaction alive(unit, write, echoing, t0, t0);
    REQUIRE(sends(alive, t0, adu));
    alive.feed(t0 + 5ms, adu);
    alive.feed(t0 + 20ms, adu);
    REQUIRE(is_done(alive, t0 + 20ms));
    CHECK(alive.outcome().value() == response{written{}});
}

TEST_CASE("serial transaction: babble after the request ends every attempt, and then the transaction")
{
    for (const duration pause : {1ms, 10ms, 19ms}) {
        CAPTURE(pause);
        serial_transaction t(unit, question, timing, t0, t0);
        REQUIRE(sends(t, t0, asked));
        time_point now = t0;
        while (!is_done(t, now) && now < t0 + 10s) {
            now += pause;
            t.feed(now, noise);
            if (!waits(t, now) && !is_done(t, now))
                t.sent(now);
        }
        // Two waits for an answer of greatest length, and one for silence between them.
        const duration longest_answer = 500ms + character_time(timing.format, max_rtu_size) + silence;
        CHECK(now <= t0 + 2 * (on_wire + longest_answer) + 500ms + pause);
        CHECK(t.outcome().has_error());
    }
}

TEST_SUITE_END();
