// A client's transaction on a line, to the microsecond: what it sends, how long it waits, when it gives up.
#include "tests/unit/mewtocol_client.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

const read_words two_registers{word_area::dt, 0, 2};
const std::string asked = "%01#RDD000000000154";  // V15
const std::string answer = "%01$RD05000A0062";
const response values = words_read{{5, 10}};

}  // namespace

TEST_CASE("mewtocol client: an answer ends it at once")
{
    client t = ask(two_registers);
    REQUIRE(sends(t, t0, asked));
    const time_point sent = t0 + on_wire(asked);
    CHECK(waits(t, t0) == sent + 500ms);
    t.feed(sent + 20ms, with_cr(answer));
    REQUIRE(is_done(t, sent + 20ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 1);
    CHECK(t.response_time() == 20ms);
    CHECK(t.line_free_from() == sent + 20ms + gap);
}

TEST_CASE("mewtocol client: an answer in pieces; once begun, silence ends it, not the timeout")
{
    client t = ask(two_registers);
    REQUIRE(sends(t, t0, asked));
    const time_point begun = t0 + on_wire(asked) + 490ms;
    const buffer whole = with_cr(answer);
    for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
        const time_point now = begun + i * 5ms;
        t.feed(now, bytes(whole).subspan(i, 1));
        CHECK(waits(t, now) == now + 100ms);
    }
    t.feed(begun + 200ms, bytes(whole).last(1));
    REQUIRE(is_done(t, begun + 200ms));
    CHECK(t.outcome().value() == values);
}

TEST_CASE("mewtocol client: silence is answered by as many retries as are allowed, then by a failure")
{
    for (unsigned retries = 0; retries <= 3; ++retries) {
        CAPTURE(retries);
        line_options options = timing;
        options.retries = retries;
        client t = ask(two_registers, one, options);
        time_point now = t0;
        for (unsigned attempt = 0; attempt <= retries; ++attempt) {
            REQUIRE(sends(t, now, asked));
            now += on_wire(asked) + 500ms;
            CHECK(waits(t, now - 1us) == now);
        }
        REQUIRE(is_done(t, now));
        CHECK(t.outcome().error() == errc::timed_out);
        CHECK(t.unanswered() == retries + 1);
        CHECK(t.unanswered_since() == t0 + on_wire(asked));
    }
}

TEST_CASE("mewtocol client: what comes instead of the answer, and what is made of it")
{
    struct {
        const char* name;
        std::string heard;
        errc why;
        bool at_once;  // no other answer can come
    } const rows[] = {
        {"a wrong check", "%01$RD05000A0063", errc::bad_checksum, true},
        {"another station", checked("%02$RD05000A00"), errc::timed_out, false},
        {"the other header", checked("<01$RD05000A00"), errc::timed_out, false},
        {"the answer to another command", "%01$RC021", errc::unexpected_answer, false},
        {"one word", checked("%01$RD0500"), errc::unexpected_answer, false},
        {"a digit that is none", checked("%01$RD05000A0G"), errc::unexpected_answer, false},
        {"an error code of three digits", checked("%01!611"), errc::unexpected_answer, false},
        {"a command", checked("%01#RT"), errc::unexpected_answer, false},
        {"noise", "hello", errc::bad_header, false},
        {"a frame of nothing", "%01", errc::bad_header, false},
        {"too long", "%01$RD" + std::string(200, '0'), errc::overlong, true},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        line_options options = timing;
        options.retries = 0;
        client t = ask(two_registers, one, options);
        REQUIRE(sends(t, t0, asked));
        const time_point timeout = t0 + on_wire(asked) + 500ms;
        t.feed(t0 + 50ms, with_cr(row.heard));
        if (!row.at_once) {
            CHECK(waits(t, t0 + 50ms) == timeout);
            client other = ask(two_registers, one, options);
            REQUIRE(sends(other, t0, asked));
            other.feed(t0 + 50ms, with_cr(row.heard));
            other.feed(t0 + 90ms, with_cr(answer));  // the right one still counts
            REQUIRE(is_done(other, t0 + 90ms));
            CHECK(other.outcome().value() == values);
        }
        REQUIRE(is_done(t, row.at_once ? t0 + 50ms : timeout));
        CHECK(t.outcome().error() == row.why);
        CHECK(t.unanswered() == (row.at_once ? 0 : 1));
    }
}

TEST_CASE("mewtocol client: an answer that lost its CR ends with silence, and the question is repeated")
{
    client t = ask(two_registers);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 50ms, to_bytes(answer));
    CHECK(waits(t, t0 + 50ms) == t0 + 150ms);
    REQUIRE(sends(t, t0 + 150ms, asked));
    t.feed(t0 + 200ms, with_cr(answer));
    REQUIRE(is_done(t, t0 + 200ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.attempts() == 2);
}

TEST_CASE("mewtocol client: a line that babbles for ever does not hold it for ever")
{
    line_options options = timing;
    options.retries = 0;
    for (const char* babble : {"xxxx", "%01$RD00"}) {
        CAPTURE(std::string(babble));
        client t = ask(two_registers, one, options);
        REQUIRE(sends(t, t0, asked));
        time_point now = t0;
        while (!is_done(t, now)) {
            REQUIRE(now < t0 + 2s);
            t.feed(now, to_bytes(babble));
            now += 5ms;
        }
        CHECK(t.outcome().has_error());
    }
}

TEST_CASE("mewtocol client: an error code is an answer and is not asked again")
{
    client t = ask(two_registers);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 50ms, with_cr("%01!6102"));
    REQUIRE(is_done(t, t0 + 50ms));
    CHECK(t.outcome().value() == response{error_code::data});
}

TEST_CASE("mewtocol client: an answer without check is taken, an echo is not")
{
    client t = ask(two_registers);
    REQUIRE(sends(t, t0, asked));
    t.feed(t0 + 10ms, with_cr(asked));
    CHECK(waits(t, t0 + 10ms) == t0 + on_wire(asked) + 500ms);
    t.feed(t0 + 50ms, with_cr("%01$RD05000A00**"));
    REQUIRE(is_done(t, t0 + 50ms));
    CHECK(t.outcome().value() == values);
    CHECK(t.echo_seen());
}

TEST_CASE("mewtocol client: nobody answers a global write, the stations get their time")
{
    client t = ask(write_words{word_area::dt, 0, {0x1234}}, station_id::global);
    const std::string global = "%FF#WDD0000000000341255";  // V66
    REQUIRE(sends(t, t0, global));
    REQUIRE(is_done(t, t0));
    CHECK(t.outcome().value() == response{no_response{}});
    CHECK(t.line_free_from() == t0 + on_wire(global) + 100ms);
}

TEST_CASE("mewtocol client: a registration is not repeated, since the second one would be refused")
{
    client t = ask(register_data{{{word_area::dt, 0}}});
    REQUIRE(sends(t, t0, checked("%01#MDD00000")));
    REQUIRE(is_done(t, t0 + 5s));
    CHECK(t.outcome().error() == errc::timed_out);
    CHECK(t.attempts() == 1);
}

TEST_CASE("mewtocol client: what does not fit into the fields or one frame is not sent")
{
    const std::vector<std::uint16_t> words(508);
    const command not_expressible[] = {
        read_words{word_area::dt, 100'000, 1},
        read_words{word_area::dt, 99'999, 2},
        read_words{word_area::dt, 0, 0},
        read_words{word_area::wr, 10'000, 1},
        read_words{word_area::id, 0, 1},
        write_words{word_area::wx, 0, {1}},
        write_words{word_area::dt, 0, words},
        fill_words{word_area::sv, 0, 1, 0},
        read_contact{{contact_area::internal_relay, 16'000}},
        read_contact{{contact_area::timer, 10'000}},
        read_contacts{{}},
        read_contacts{std::vector<contact>(9, {contact_area::internal_relay, 0})},
        write_contact{{{contact_area::external_input, 0}, true}},
        register_contacts{{}},
        register_data{{{word_area::system, 0}}},
    };
    for (const command& each : not_expressible) {
        CAPTURE(each.index());
        client t = ask(each, one, timing, header::expansion);
        REQUIRE(is_done(t, t0));
        CHECK(t.outcome().error() == errc::not_expressible);
        CHECK(t.attempts() == 0);
    }
    client nobody = ask(two_registers, station_id{100});
    CHECK(is_done(nobody, t0));
    client everybody = ask(two_registers, station_id::global);
    CHECK(is_done(everybody, t0));
    CHECK(everybody.outcome().error() == errc::not_expressible);
}

TEST_CASE("mewtocol client: it waits for a quiet line, but not for ever")
{
    client t(conversation(header::normal, one, two_registers), timing, t0 + 5ms, t0);
    CHECK(waits(t, t0) == t0 + 5ms);
    t.feed(t0 + 4ms, to_bytes("x"));
    CHECK(waits(t, t0 + 5ms) == t0 + 4ms + gap);
    CHECK(t.stray_bytes() == 1);

    time_point now = t0 + 5ms;
    while (!is_done(t, now)) {
        REQUIRE(now < t0 + 1s);
        t.feed(now, to_bytes("x"));
        now += 500us;
    }
    CHECK(t.outcome().error() == errc::line_not_quiet);
}

TEST_SUITE_END();
