#include "protocols/general_purpose/exchange.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

namespace {

constexpr message_form cr{start_code::none, end_code::cr, {}, {}};
constexpr message_form quiet{start_code::none, end_code::silence, 50ms, {}};

exchange_options usual()
{
    exchange_options o;
    o.format = {10'000, 8, parity::none, 1};  // 1 ms for each character
    o.response_timeout = 100ms;
    o.retries = 1;
    o.silence = 20ms;
    return o;
}

struct bench {
    explicit bench(const exchange_options& options = usual(), const message_form& form = cr,
                   expect answer = expect::message, time_point line_free_from = t0)
        : in(form), ex(in, raw("Q\r"), answer, options, line_free_from, t0)
    {
    }

    void sends(time_point at)
    {
        const auto action = ex.next(at);
        const auto* sending = std::get_if<line_action::send>(&action);
        REQUIRE(sending != nullptr);
        CHECK(text_of(buffer(sending->message.begin(), sending->message.end())) == "Q\r");
        ex.sent(at);
    }

    void waits(time_point at, time_point until)
    {
        const auto action = ex.next(at);
        const auto* waiting = std::get_if<line_action::wait>(&action);
        REQUIRE(waiting != nullptr);
        CHECK(waiting->until == until);
    }

    void ends(time_point at, std::string_view outcome)
    {
        REQUIRE(std::holds_alternative<line_action::done>(ex.next(at)));
        CHECK(text_of(ex.outcome()) == outcome);
    }

    texts others()
    {
        texts all;
        for (const auto& each : ex.take_others())
            all.push_back(text_of(each));
        return all;
    }

    message_framer in;
    exchange ex;
};

}  // namespace

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

TEST_CASE("message exchange: the echo of the own message is taken away at every cut")
{
    auto options = usual();
    options.echo = local_echo::on;
    every_cut(raw("Q\r12\r"), [&](const pieces& cut) {
        bench b(options);
        b.sends(t0);
        for (const bytes each : cut)
            b.ex.feed(t0 + 5ms, each);
        b.ends(t0 + 5ms, "12");
    });
    bench alone(options);
    alone.sends(t0);
    alone.ex.feed(t0 + 5ms, raw("Q\r"));
    alone.waits(t0 + 5ms, t0 + 102ms);

    bench equal;  // without echo the same text is an answer
    equal.sends(t0);
    equal.ex.feed(t0 + 5ms, raw("Q\r"));
    equal.ends(t0 + 5ms, "Q");
}

TEST_CASE("message exchange: an echo that came back changed is a collision, and nothing behind it an answer")
{
    auto options = usual();
    options.echo = local_echo::on;
    bench b(options);
    b.sends(t0);
    b.ex.feed(t0 + 5ms, raw("R\r12\r"));
    b.waits(t0 + 5ms, t0 + 25ms);
    b.sends(t0 + 25ms);
    b.ex.feed(t0 + 30ms, raw("Q\r13\r"));
    b.ends(t0 + 30ms, "13");
    CHECK(b.others().empty());

    options.retries = 0;
    bench failing(options);
    failing.sends(t0);
    failing.ex.feed(t0 + 5ms, raw("QQ"));
    failing.ends(t0 + 25ms, "! own request came back changed");
}

TEST_CASE("message exchange: after a collision the line is heard again")
{
    auto options = usual();
    options.echo = local_echo::on;
    options.send_wait = 10ms;
    bench b(options);
    b.sends(t0 + 10ms);
    b.ex.feed(t0 + 15ms, raw("QQ"));
    b.ex.fault(t0 + 15ms, errc::bad_parity);  // of the same bytes
    b.waits(t0 + 35ms, t0 + 45ms);
    b.ex.feed(t0 + 40ms, raw("news\r"));
    b.sends(t0 + 45ms);
    CHECK(b.others() == texts{"news"});
    b.ex.feed(t0 + 50ms, raw("QQ"));
    b.ends(t0 + 70ms, "! own request came back changed");
    b.ex.feed(t0 + 80ms, raw("more\r"));
    texts rest;
    drain(b.in, t0 + 80ms, rest);
    CHECK(rest == texts{"more"});
}

TEST_CASE("message listener: each message by itself, none lost between two listeners")
{
    message_framer in(cr);
    texts all;
    time_point now = t0;
    in.feed(now, raw("1\r2\r3"));
    for (int i = 0; i < 2; ++i) {
        listener each(in, now + 1s);
        REQUIRE(std::holds_alternative<line_action::done>(each.next(now)));
        all.push_back(text_of(each.outcome()));
    }
    listener last(in, now + 1s);
    CHECK(std::get<line_action::wait>(last.next(now)).until == now + 1s);
    last.feed(now + 5ms, raw("4\r"));
    REQUIRE(std::holds_alternative<line_action::done>(last.next(now + 5ms)));
    all.push_back(text_of(last.outcome()));
    CHECK(all == texts{"1", "2", "34"});
    CHECK(std::holds_alternative<line_action::done>(last.next(now + 6ms)));
}

TEST_CASE("message listener: it ends when somebody wants to send, and wakes for a silence")
{
    message_framer in(quiet);
    listener idle(in, t0 + 1s);
    CHECK(std::holds_alternative<line_action::wait>(idle.next(t0)));
    REQUIRE(std::holds_alternative<line_action::done>(idle.next(t0 + 1s)));
    CHECK(text_of(idle.outcome()) == "! no answer");

    listener hearing(in, t0 + 2s);
    hearing.feed(t0 + 1s, raw("12"));
    CHECK(std::get<line_action::wait>(hearing.next(t0 + 1s)).until == t0 + 1050ms);
    hearing.fault(t0 + 1s, errc::bad_parity);
    REQUIRE(std::holds_alternative<line_action::done>(hearing.next(t0 + 1s)));
    CHECK(text_of(hearing.outcome()) == "! parity error");
}

TEST_SUITE_END();
