// A transaction in ASCII: the frames, the second that may pass inside of one, damage and strangers.
#include "tests/support/every_cut.hpp"
#include "tests/support/rtu_script.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

const unit_id unit{0x11};
const request question = read_table{table::holding_registers, address{0x6B}, 3};
const frame answer{unit, {0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40}};
const response values = registers_read{{0xAE41, 0x5652, 0x4340}};

buffer text(std::string_view of) { return buffer(of.begin(), of.end()); }

const buffer asked = text(":1103006B00037E\r\n");  // the example of V1.1b3 section 6.3, LRC by hand

constexpr serial_options timing{.format = {.baud_rate = 19200, .data_bits = 7},
                                .response_timeout = 500ms,
                                .retries = 1,
                                .echo = local_echo::off,
                                .mode = framing::ascii};

buffer damaged(buffer adu)
{
    adu[4] = adu[4] == '0' ? '1' : '0';
    return adu;
}

}  // namespace

TEST_CASE("serial transaction, ASCII: an answer ends it at once, at every cut")
{
    every_cut(encode_ascii(answer), [&](const pieces& cut) {
        serial_transaction t(unit, question, timing, t0, t0);
        REQUIRE(sends(t, t0, asked));
        for (const bytes each : cut)
            t.feed(t0 + 20ms, each);
        REQUIRE(is_done(t, t0 + 20ms));
        CHECK(t.outcome().value() == values);
    });
}

TEST_CASE("serial transaction, ASCII: a station's own delimiter ends request and answer")
{
    serial_options changed = timing;
    changed.delimiter = '$';
    serial_transaction t(unit, question, changed, t0, t0);
    REQUIRE(sends(t, t0, encode_ascii({unit, encode_request(question)}, '$')));
    t.feed(t0 + 20ms, encode_ascii(answer, '$'));
    REQUIRE(is_done(t, t0 + 20ms));
    CHECK(t.outcome().value() == values);
}

TEST_CASE("serial transaction, ASCII: inside a frame a second may pass, behind a damaged one only the silence")
{
    const buffer whole = encode_ascii(answer);
    serial_transaction slow(unit, question, timing, t0, t0);
    REQUIRE(sends(slow, t0, asked));
    slow.feed(t0 + 20ms, bytes(whole).first(5));
    CHECK(waits(slow, t0 + 20ms) == t0 + 20ms + 1s);
    slow.feed(t0 + 1s, bytes(whole).subspan(5));
    REQUIRE(is_done(slow, t0 + 1s));
    CHECK(slow.outcome().value() == values);

    serial_transaction again(unit, question, timing, t0, t0);
    REQUIRE(sends(again, t0, asked));
    again.feed(t0 + 20ms, damaged(whole));
    CHECK(waits(again, t0 + 20ms) == t0 + 40ms);
    CHECK(sends(again, t0 + 40ms, asked));
    CHECK(again.faults() == std::vector<answer_fault>{{errc::bad_checksum, {}}});
}

TEST_CASE("serial transaction, ASCII: strangers and noise leave the response timeout running")
{
    const frame other_unit{unit_id{0x12}, answer.pdu};
    const frame other_function{unit, {0x04, 0x02, 1, 2}};
    for (const buffer& before : {buffer{0x00, 0xFF}, encode_ascii(other_unit), encode_ascii(other_function)}) {
        serial_transaction t(unit, question, timing, t0, t0);
        REQUIRE(sends(t, t0, asked));
        t.feed(t0 + 20ms, before);
        CHECK(*waits(t, t0 + 20ms) > t0 + 500ms);
        t.feed(t0 + 400ms, encode_ascii(answer));
        REQUIRE(is_done(t, t0 + 400ms));
        CHECK(t.outcome().value() == values);
    }
}

TEST_CASE("serial transaction, ASCII: the echo of a read is left out")
{
    serial_options echoing = timing;
    echoing.echo = local_echo::automatic;
    serial_transaction t(unit, question, echoing, t0, t0);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 1ms, asked);
    t.feed(t0 + 20ms, encode_ascii(answer));
    REQUIRE(is_done(t, t0 + 20ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.echo_seen());
}

TEST_SUITE_END();
