#include "tests/unit/general_purpose_bench.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

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
