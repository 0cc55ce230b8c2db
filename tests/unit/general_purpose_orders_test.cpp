// Messages that somebody orders beside the sendings of a line, in virtual time.
#include "bridge/messages/line_messages.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

namespace {

constexpr wall_time noon{1'700'000'000'000'000'000};

struct order_bench {
    order_bench() { line.port_opened(); }

    std::string next_sent()
    {
        const auto q = line.next(t0, noon);
        if (!q)
            return "";
        line.sent(*q, noon);
        line.answered(*q, {}, t0, noon);
        return std::string(q->content.begin(), q->content.end());
    }
    std::string outcomes()
    {
        std::string all;
        for (const auto& each : line.take_ordered())
            all += std::to_string(each.number) + (each.failed ? " failed: " + each.reason : std::string(" ok")) + "\n";
        return all;
    }

    line_messages line{{"text", {}, {}, 1s}};
};

}  // namespace

TEST_CASE("ordered messages: each is sent once, in its turn, and its outcome is told")
{
    order_bench b;
    CHECK(b.next_sent() == "");
    CHECK(b.line.order(raw("one"), t0) == 1);
    CHECK(b.line.order(raw("two"), t0) == 2);
    CHECK_FALSE(b.line.has_begun(1));
    CHECK(b.outcomes() == "");
    CHECK(b.next_sent() == "one");
    CHECK(b.line.has_begun(1));
    CHECK_FALSE(b.line.has_begun(2));
    CHECK(b.outcomes() == "1 ok\n");
    CHECK(b.next_sent() == "two");
    CHECK(b.outcomes() == "2 ok\n");
    CHECK(b.next_sent() == "");
    const auto said = b.line.take_messages();
    REQUIRE(said.size() == 2);
    CHECK(said[0].way == message_direction::sent);
    CHECK(said[0].name == "");
}

TEST_CASE("ordered messages: one that is withdrawn is not sent, and the others are")
{
    order_bench b;
    b.line.order(raw("one"), t0);
    b.line.order(raw("two"), t0);
    b.line.withdraw(1);
    CHECK(b.next_sent() == "two");
    b.line.order(raw("three"), t0);
    b.line.withdraw(3);
    CHECK(b.next_sent() == "");
    CHECK(b.outcomes() == "2 ok\n");
    b.line.order(raw("four"), t0);
    CHECK(b.next_sent() == "four");
}

TEST_CASE("ordered messages: without a port, and when it is lost meanwhile, it is said; too many are refused")
{
    order_bench b;
    for (int i = 0; i < 16; ++i)
        CHECK(b.line.order(raw("x"), t0));
    CHECK_FALSE(b.line.order(raw("x"), t0));
    const auto q = b.line.next(t0, noon);
    REQUIRE(q);
    b.line.interrupted(*q, t0);
    CHECK(b.outcomes() == "1 failed: line text was lost while the message was sent\n");
    b.line.port_lost();
    CHECK(b.line.take_ordered().size() == 15);
    b.line.order(raw("x"), t0);
    CHECK(b.outcomes() == "17 failed: line text is out of reach: the port is absent\n");
}

TEST_CASE("ordered messages: what cannot be a message")
{
    order_bench b;
    CHECK(b.line.can_send(raw("a")));
    CHECK(b.line.can_send({}));                       // its end code alone
    CHECK_FALSE(b.line.can_send(buffer(4096, 'a')));  // the end code needs room
}

TEST_SUITE_END();
