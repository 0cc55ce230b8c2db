#include "tests/unit/general_purpose_bench.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

TEST_CASE("message exchange: a question and its answer")
{
    bench b;
    b.sends(t0);
    b.waits(t0, t0 + 102ms);  // 2 characters, then the response timeout
    b.ex.feed(t0 + 50ms, raw("12"));
    b.waits(t0 + 50ms, t0 + 102ms);
    b.ex.feed(t0 + 52ms, raw("3\r"));
    b.ends(t0 + 52ms, "123");
    CHECK(b.ex.attempts() == 1);
    CHECK(b.ex.response_time() == 50ms);
    CHECK(b.others().empty());
}

TEST_CASE("message exchange: without an answer it is asked again, then given up")
{
    bench b;
    b.sends(t0);
    b.waits(t0 + 101ms, t0 + 102ms);
    b.sends(t0 + 102ms);
    b.waits(t0 + 102ms, t0 + 204ms);
    b.ends(t0 + 204ms, "! no answer");
    CHECK(b.ex.attempts() == 2);
    CHECK(b.ex.unanswered() == 2);
    CHECK(b.ex.unanswered_since() == t0 + 2ms);

    bench again;
    again.sends(t0);
    again.sends(t0 + 102ms);
    again.ex.feed(t0 + 110ms, raw("1\r"));
    again.ends(t0 + 110ms, "1");
    CHECK(again.ex.unanswered() == 1);  // it may be the first one's answer, and another come
    CHECK(again.ex.unanswered_since() == t0 + 2ms);
}

TEST_CASE("message exchange: a long answer may take longer than the response timeout")
{
    bench b;
    b.sends(t0);
    time_point now = t0 + 90ms;
    for (int i = 0; i < 40; ++i, now += 10ms) {
        b.ex.feed(now, raw("x"));
        b.waits(now, std::max(now + 20ms, t0 + 102ms));
    }
    b.ex.feed(now, raw("\r"));
    b.ends(now, std::string(40, 'x'));
}

TEST_CASE("message exchange: an answer that stops without its end code is incomplete, and does not spoil the next")
{
    bench b;
    b.sends(t0);
    b.ex.feed(t0 + 95ms, raw("12"));
    b.waits(t0 + 102ms, t0 + 115ms);
    b.sends(t0 + 115ms);
    b.ex.feed(t0 + 120ms, raw("34\r"));
    b.ends(t0 + 120ms, "34");
    CHECK(b.others() == texts{"! incomplete frame"});

    auto once = usual();
    once.retries = 0;
    bench failing(once);
    failing.sends(t0);
    failing.ex.feed(t0 + 95ms, raw("12"));
    failing.ends(t0 + 115ms, "! incomplete frame");
}

TEST_CASE("message exchange: noise leaves the response timeout running")
{
    bench b;
    b.sends(t0);
    b.ex.feed(t0 + 5ms, raw("\xFF"));
    b.waits(t0 + 5ms, t0 + 102ms);
    b.waits(t0 + 40ms, t0 + 102ms);
}

TEST_CASE("message exchange: a damaged answer is asked for again when the line fell silent")
{
    bench b;
    b.sends(t0);
    b.ex.feed(t0 + 10ms, raw("12"));
    b.ex.fault(t0 + 11ms, errc::bad_parity);
    b.ex.feed(t0 + 12ms, raw("3\r"));
    b.waits(t0 + 12ms, t0 + 32ms);
    b.sends(t0 + 32ms);
    b.ex.feed(t0 + 50ms, raw("123\r"));
    b.ends(t0 + 50ms, "123");
    CHECK(b.others() == texts{"! parity error"});
    CHECK(b.ex.unanswered() == 0);  // it had answered

    auto once = usual();
    once.retries = 0;
    bench failing(once);
    failing.sends(t0);
    failing.ex.fault(t0 + 11ms, errc::bad_stop_bit);
    failing.waits(t0 + 11ms, t0 + 31ms);
    failing.ends(t0 + 31ms, "! framing error");
    CHECK_FALSE(failing.in.inside());
}

TEST_CASE("message exchange: a line that babbles for ever is given up")
{
    auto once = usual();
    once.retries = 0;
    bench b(once);
    b.sends(t0);
    const time_point last = t0 + 102ms + 4096ms + 20ms;
    time_point now = t0 + 5ms;
    for (; now < last; now += 5ms) {
        b.ex.feed(now, raw("x"));
        REQUIRE(std::holds_alternative<line_action::wait>(b.ex.next(now)));
    }
    b.ex.feed(now, raw("x"));
    b.ends(now, "! incomplete frame");
}

TEST_CASE("message exchange: where silence ends messages, it ends the answer")
{
    bench b(usual(), quiet);
    b.sends(t0);
    b.ex.feed(t0 + 90ms, raw("12"));
    b.waits(t0 + 90ms, t0 + 140ms);  // 50 ms, although the line counts as silent after 20
    b.waits(t0 + 115ms, t0 + 140ms);
    b.ends(t0 + 140ms, "12");
}

TEST_CASE("message exchange: what came before the question is not its answer, and is not lost")
{
    bench b;
    b.in.feed(t0, raw("old\rhal"));
    b.sends(t0);
    b.ex.feed(t0 + 5ms, raw("f\rnew\rmore\r"));
    b.ends(t0 + 5ms, "half");  // nobody can know: messages have no numbers
    CHECK(b.others() == texts{"old"});

    texts rest;
    drain(b.in, t0 + 6ms, rest);  // they wait for whoever asks next
    CHECK(rest == texts{"new", "more"});
}

TEST_CASE("message exchange: the send wait time comes before each sending (9.2.1)")
{
    auto options = usual();
    options.send_wait = 30ms;
    bench b(options);
    b.waits(t0, t0 + 30ms);
    b.waits(t0 + 29ms, t0 + 30ms);
    b.sends(t0 + 30ms);
    b.waits(t0 + 132ms, t0 + 162ms);
    b.sends(t0 + 162ms);
}

TEST_CASE("message exchange: it waits until the line is free, but not for ever")
{
    auto options = usual();
    options.gap = 10ms;
    bench b(options, cr, expect::message, t0 + 5ms);
    b.waits(t0, t0 + 5ms);
    b.ex.feed(t0 + 4ms, raw("hello\r"));
    b.waits(t0 + 5ms, t0 + 14ms);
    b.sends(t0 + 14ms);
    CHECK(b.others() == texts{"hello"});

    bench busy(options);
    time_point now = t0;
    for (; now < t0 + 100ms; now += 5ms) {
        busy.ex.feed(now, raw("x"));
        REQUIRE(std::holds_alternative<line_action::wait>(busy.ex.next(now)));
    }
    busy.ex.feed(now, raw("x"));
    busy.ends(now, "! line not quiet");
}

TEST_CASE("message exchange: what needs no answer is done when it is sent")
{
    auto options = usual();
    options.gap = 10ms;
    bench b(options, cr, expect::nothing);
    b.sends(t0);
    b.ends(t0, "");
    CHECK(b.ex.line_free_from() == t0 + 12ms);
    CHECK(b.ex.attempts() == 1);
}

TEST_SUITE_END();
