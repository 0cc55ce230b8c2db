// What the messages of a line do to memory, quality and DDS, in virtual time.
#include "bridge/messages/line_messages.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/plc_fixture.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;
using general_purpose::expect;
using general_purpose::when_full;

namespace {

constexpr wall_time noon{1'700'000'000'000'000'000};

struct line_bench : fx3u_fixture {
    explicit line_bench(general_purpose::message_form form = {}) : line({"text", form, timing(), 1s}) {}

    static general_purpose::exchange_options timing()
    {
        general_purpose::exchange_options o;
        o.retries = 0;
        return o;
    }

    plc_block block(const char* name, const char* device, std::uint32_t count)
    {
        return {name, &plc, *plc::parse_device(device), at(device), count};
    }
    plc_bit bit_at(const char* device) { return {&plc, at(device)}; }

    message_row weighing(duration longest = {}, std::string answer_to = {})
    {
        message_row row;
        row.name = "weighing";
        row.form = *pattern::parse("{state:text(2)},{weight:number}kg");
        row.fields = {{.name = "weight", .type = value_type::int16, .decimals = 1},
                      {.name = "state", .type = value_type::text, .characters = 2}};
        row.into = {block("weighing.weight", "D200", 1), block("weighing.state", "D201", 1)};
        row.longest_silence = longest;
        row.answer_to = std::move(answer_to);
        return row;
    }

    send_row asking(const char* name, duration period = 1s)
    {
        send_row row;
        row.name = name;
        row.text = raw(name);
        row.period = period;
        row.answer = expect::message;
        row.response_timeout = 500ms;
        return row;
    }

    void hears(std::string_view message, time_point at = t0) { line.received(raw(message), at, noon); }

    // Drains the memory, as the gateway does. True when the line has something to do.
    bool settle(time_point at = t0)
    {
        bool due = false;
        for (const plc::change& each : plc.memory().take_changes())
            due = line.memory_changed(plc, each, at) || due;
        return due;
    }

    quality said(std::string_view route, time_point at)
    {
        for (const sample& each : line.take_samples(at))
            if (each.route == route)
                return each.state;
        FAIL("not said: " << std::string(route));
        return {};
    }

    std::string events()
    {
        std::string all;
        for (const line_event& each : line.take_events())
            all += each.text + "\n";
        return all;
    }

    line_messages line;
};

}  // namespace

TEST_CASE("line messages: fields go into the memory and to DDS, all of a message or none")
{
    line_bench b;
    b.line.add(b.weighing());
    b.line.port_opened();
    CHECK(b.said("weighing.weight", t0) == quality::never_read);
    CHECK(b.line.take_samples(t0).empty());
    CHECK(b.line.routes_up() == 1);  // it may wait for its first message

    b.hears("ST,12.5kg");
    CHECK(b.word("D200") == 125);
    CHECK(b.word("D201") == ('S' | 'T' << 8));
    auto samples = b.line.take_samples(t0);
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].route == "weighing.weight");
    CHECK(samples[0].area == "D");
    CHECK(samples[0].first == 200);
    CHECK(samples[0].words == std::vector<std::uint16_t>{125});
    CHECK(samples[0].state == quality::good);
    CHECK(samples[0].source == noon);

    b.hears("US,9999.9kg");  // does not fit an int16 with one decimal
    CHECK(b.word("D200") == 125);
    CHECK(b.word("D201") == ('S' | 'T' << 8));
    CHECK(b.line.take_samples(t0).empty());
    CHECK(b.line.status(status_word::refused) == 1);

    const auto messages = b.line.take_messages();
    REQUIRE(messages.size() == 2);
    CHECK(messages[0].name == "weighing");
    CHECK(messages[0].reason.empty());
    CHECK(text_of(messages[0].content) == "ST,12.5kg");
    CHECK(messages[1].name.empty());
    CHECK(messages[1].reason == "weighing: weight does not fit the type");
}

TEST_CASE("line messages: what no pattern takes is said once in ten seconds, and counted")
{
    line_bench b;
    b.line.add(b.weighing());
    for (int i = 0; i < 50; ++i)
        b.hears("ER", t0 + i * 100ms);
    const std::string first = b.events();
    CHECK(first.starts_with("line text: no pattern takes the message ER: weighing: "));
    CHECK(first.find('\n') == first.size() - 1);
    b.hears("ER", t0 + 10s);
    CHECK(b.events().ends_with("(and 49 more since the last report)\n"));
    CHECK(b.line.status(status_word::refused) == 51);
    CHECK(b.line.status(status_word::received) == 51);
}

TEST_CASE("line messages: the first pattern that fits takes a message")
{
    line_bench b;
    message_row any = b.weighing();
    any.name = "any";
    any.form = *pattern::parse("{text}");
    any.fields = {{.name = "text", .type = value_type::text, .characters = 20}};
    any.into = {b.block("any.text", "D300", 10)};
    b.line.add(b.weighing());
    b.line.add(std::move(any));
    b.hears("ST,1kg");
    b.hears("other");
    const auto messages = b.line.take_messages();
    REQUIRE(messages.size() == 2);
    CHECK(messages[0].name == "weighing");
    CHECK(messages[1].name == "any");
    CHECK(b.word("D300") == ('o' | 't' << 8));
    CHECK(b.line.status(status_word::refused) == 0);
}

TEST_CASE("line messages: the same value is said again after the longest silence, a missing one grows stale")
{
    line_bench b;
    b.line.add(b.weighing(3s));
    b.line.port_opened();
    b.line.take_samples(t0);
    CHECK(b.line.routes_up() == 0);  // it should come by itself
    b.hears("ST,1kg", t0);
    CHECK(b.said("weighing.weight", t0) == quality::good);
    b.hears("ST,1kg", t0 + 500ms);
    CHECK(b.line.take_samples(t0 + 500ms).empty());
    CHECK(b.line.wake_at() == t0 + 1s);
    CHECK(b.said("weighing.weight", t0 + 1s) == quality::good);
    CHECK(b.line.wake_at() == t0 + 3500ms);
    CHECK(b.line.take_samples(t0 + 3499ms).empty());
    CHECK(b.said("weighing.weight", t0 + 3500ms) == quality::stale);
    CHECK(b.events() == "line text, message weighing has not come for 3000 ms\n");
    CHECK(b.line.wake_at() == time_point::max());
    b.hears("ST,1kg", t0 + 4s);
    CHECK(b.said("weighing.weight", t0 + 4s) == quality::good);

    b.line.port_lost();
    CHECK(b.said("weighing.weight", t0 + 4s) == quality::comm_error);
    sample block{.route = "block", .area = "D", .words = {}, .state = quality::good, .source = wall_time{1}};
    b.line.worsen(block, b.plc, b.at("D190"), 16 * 20);
    CHECK(block.state == quality::comm_error);
    sample beside{.route = "block", .area = "D", .words = {}, .state = quality::good, .source = wall_time{1}};
    b.line.worsen(beside, b.plc, b.at("D202"), 16 * 20);
    CHECK(beside.state == quality::good);
}

TEST_CASE("line messages: whole messages wait for their reader in eight buffers")
{
    line_bench b;
    b.line.add(raw_row{b.block("codes", "D100", 4), b.bit_at("M0"), when_full::drop});
    b.line.show_status_in(b.block("status", "D300", 8));
    for (const char* each : {"1", "2", "3", "4", "5", "6", "7", "8", "9"})
        b.hears(each);
    CHECK(b.bit("M0"));
    CHECK(b.word("D100") == 1);
    CHECK(b.word("D101") == '1');
    CHECK(b.word("D302") == 8);
    CHECK(b.word("D300") == 0);
    CHECK(b.events().empty());
    b.hears("10");
    CHECK(b.word("D300") == general_purpose::receive_error::buffers_full);
    CHECK(b.word("D305") == 1);
    CHECK(b.events() == "line text, received codes: all eight buffers are full, messages are lost until the reader "
                        "clears the ready bit\n");
    b.hears("11");
    CHECK(b.events().empty());
    b.settle();

    for (const char each : {'2', '3', '4', '5', '6', '7', '8', '9'}) {
        b.set_bit("M0", false);
        CHECK(b.settle());
        CHECK(b.line.wake_at() == time_point{});
        CHECK_FALSE(b.line.next(t0, noon));
        CHECK(b.bit("M0"));
        CHECK(b.word("D101") == static_cast<std::uint16_t>(each));
        CHECK_FALSE(b.settle());
    }
    CHECK(b.word("D302") == 0);
    CHECK(b.word("D305") == 2);
}

TEST_CASE("line messages: a message larger than its words is lost, and the next one comes")
{
    line_bench b;
    b.line.add(raw_row{b.block("codes", "D100", 3), {}, when_full::drop});
    b.hears("12345");
    CHECK(b.word("D100") == 0);
    CHECK(b.events() == "line text, received codes: a message of 5 bytes does not fit into 3 words\n");
    CHECK(b.line.status(status_word::lost) == 1);
    b.hears("1234");
    CHECK(b.word("D100") == 4);
    CHECK(b.word("D102") == ('3' | '4' << 8));
}

TEST_CASE("line messages: the reset bit clears errors and buffers once for each rise")
{
    line_bench b;
    b.line.add(raw_row{b.block("codes", "D100", 3), b.bit_at("M0"), when_full::stop});
    b.line.reset_by(b.bit_at("M9"));
    for (int i = 0; i < 12; ++i)
        b.hears("x");
    b.line.received(make_error_code(errc::bad_parity), t0, noon);
    CHECK(b.line.status(status_word::error_code) ==
          (general_purpose::receive_error::buffers_full | general_purpose::receive_error::parity));
    CHECK(b.line.status(status_word::error_count) == 1);
    b.settle();
    b.set_bit("M9", true);
    CHECK(b.settle());
    b.line.next(t0, noon);
    CHECK(b.line.status(status_word::error_code) == 0);
    CHECK(b.line.status(status_word::waiting) == 0);
    for (int i = 0; i < 9; ++i)
        b.hears("y");
    CHECK(b.line.status(status_word::waiting) == 8);
    b.set_bit("M9", false);
    CHECK_FALSE(b.settle());
    b.line.next(t0, noon);
    CHECK(b.line.status(status_word::waiting) == 8);
}

TEST_CASE("line messages: a bit that comes on sends words of the memory once")
{
    line_bench b({general_purpose::start_code::stx, general_purpose::end_code::etx, {}, {}});
    send_row row;
    row.name = "command";
    row.words = b.block("command", "D400", 4);
    row.trigger = b.bit_at("M20");
    b.line.add(std::move(row));
    b.line.show_status_in(b.block("status", "D300", 8));
    b.line.start(t0);
    b.set("D400", 3);
    b.set("D401", 'A' | 'B' << 8);
    b.set("D402", 'C');
    CHECK_FALSE(b.settle());
    b.set_bit("M20", true);
    CHECK(b.settle());
    auto question = b.line.next(t0, noon);
    REQUIRE(question);
    CHECK(text_of(question->message) == "\x02"
                                        "ABC\x03");
    CHECK(question->answer == expect::nothing);
    b.line.sent(*question, noon);
    b.line.answered(*question, {}, t0, noon);
    CHECK_FALSE(b.line.next(t0, noon));
    const auto messages = b.line.take_messages();
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].way == message_direction::sent);
    CHECK(messages[0].name == "command");
    CHECK(text_of(messages[0].content) == "ABC");

    b.set("D400", 7);  // one more than four words hold
    b.set_bit("M20", false);
    b.settle();
    b.set_bit("M20", true);
    b.settle();
    CHECK_FALSE(b.line.next(t0, noon));
    CHECK(b.word("D306") == 1);
    CHECK(b.word("D307") == 1);
    CHECK(b.events().starts_with("line text, send command fails: "));
}

TEST_CASE("line messages: an answer belongs to its question")
{
    line_bench b;
    b.line.add(b.asking("A"));
    b.line.add(b.asking("B"));
    b.line.add(b.weighing({}, "B"));
    b.line.start(t0);
    auto first = b.line.next(t0, noon);
    REQUIRE(first);
    CHECK(text_of(first->message) == "A\r");
    CHECK(first->timing.response_timeout == 500ms);
    b.line.answered(*first, raw("ST,1kg"), t0, noon);
    b.hears("ST,2kg");
    CHECK(b.word("D200") == 0);
    CHECK(b.line.status(status_word::refused) == 2);
    auto second = b.line.next(t0, noon);
    REQUIRE(second);
    CHECK(text_of(second->message) == "B\r");
    b.line.answered(*second, raw("ST,3kg"), t0, noon);
    CHECK(b.word("D200") == 30);
    b.line.take_samples(t0);
    b.events();

    // A does not answer: that says nothing about B's values, but late answers get their time.
    first = b.line.next(t0 + 1s, noon);
    REQUIRE(first);
    b.line.failed(*first, make_error_code(errc::timed_out), t0 + 1500ms, 1);
    CHECK(b.events().starts_with("line text, send A fails: "));
    CHECK_FALSE(b.line.next(t0 + 1999ms, noon));
    CHECK(b.line.wake_at() == t0 + 2s);
    second = b.line.next(t0 + 2s, noon);
    REQUIRE(second);
    CHECK(text_of(second->message) == "B\r");
    b.line.failed(*second, make_error_code(errc::timed_out), t0 + 2500ms, 1);
    CHECK(b.said("weighing.weight", t0 + 2500ms) == quality::comm_error);
    CHECK(b.line.status(status_word::unanswered) == 2);
    CHECK(b.word("D200") == 30);
}

TEST_CASE("line messages: what the port of an FP7 shows beside the status")
{
    line_bench b;
    b.line.add(raw_row{b.block("codes", "D100", 4), b.bit_at("M0"), when_full::drop});
    b.line.add(b.weighing());
    b.hears("1");  // 4.1, X4: copied to devices
    port_news news = b.line.take_port_news();
    CHECK(news.copied);
    CHECK_FALSE(b.line.take_port_news().copied);
    b.hears("2");  // waits, and no pattern takes it
    CHECK_FALSE(b.line.take_port_news().copied);
    CHECK(b.line.status(status_word::waiting) == 1);
    b.hears("ST,1kg");  // waits, but a pattern reads it
    CHECK(b.line.take_port_news().copied);
}

TEST_CASE("line messages: a wrong count of bytes to send, and a reset from outside")
{
    line_bench b;
    b.line.add(raw_row{b.block("codes", "D100", 4), b.bit_at("M0"), when_full::drop});
    send_row row;
    row.name = "command";
    row.words = b.block("command", "D400", 4);
    row.trigger = b.bit_at("M20");
    b.line.add(std::move(row));
    b.line.show_status_in(b.block("status", "D300", 8));
    b.line.start(t0);
    b.set("D400", 7);  // more than four words hold: 10.3.2, D+4 bit 9
    b.settle();
    b.set_bit("M20", true);
    b.settle();
    CHECK_FALSE(b.line.next(t0, noon));
    CHECK(b.line.take_port_news().bad_send_count);

    b.hears("1");
    b.hears("2");
    CHECK(b.word("D302") == 1);
    b.line.received(make_error_code(errc::bad_parity), t0, noon);
    CHECK(b.word("D300") == general_purpose::receive_error::parity);
    b.line.reset_channel();
    CHECK(b.word("D300") == 0);
    CHECK(b.word("D302") == 0);
    const port_news news = b.line.take_port_news();
    CHECK(news.reset);
    CHECK_FALSE(news.copied);  // before the reset
}

TEST_CASE("line messages: a reset while a message is asked leaves time for its answer")
{
    line_bench b;
    b.line.add(b.asking("A", 100ms));
    b.line.start(t0);
    auto question = b.line.next(t0, noon);
    REQUIRE(question);
    b.line.given_up(*question, t0, 0);  // not sent yet
    question = b.line.next(t0 + 100ms, noon);
    REQUIRE(question);
    b.line.sent(*question, noon);
    b.line.given_up(*question, t0 + 100ms, 1);
    CHECK_FALSE(b.line.next(t0 + 599ms, noon));
    CHECK(b.line.next(t0 + 600ms, noon));
    CHECK(b.line.status(status_word::unanswered) == 0);
    CHECK(b.events().empty());
}
