#include "bridge/messages/send_schedule.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

using source = std::optional<std::size_t>;

TEST_CASE("send schedule: a periodic message comes at once and then on its grid")
{
    send_schedule s;
    const auto scale = s.add_periodic(100ms);
    CHECK(s.wake_at() == time_point::max());
    CHECK_FALSE(s.next(t0).has_value());
    s.start(t0);
    CHECK(s.wake_at() == t0);
    CHECK(s.next(t0) == source(scale));
    CHECK_FALSE(s.next(t0 + 150ms).has_value());  // under way
    CHECK(s.wake_at() == time_point::max());
    s.finished(scale);
    CHECK(s.wake_at() == t0 + 100ms);
    CHECK_FALSE(s.next(t0 + 99ms).has_value());
    CHECK(s.next(t0 + 130ms) == source(scale));
    s.finished(scale);
    CHECK(s.wake_at() == t0 + 200ms);
    CHECK(s.missed(scale) == 0);
}

TEST_CASE("send schedule: periods that passed are counted, not made up for")
{
    send_schedule s;
    const auto scale = s.add_periodic(100ms);
    s.start(t0);
    CHECK(s.next(t0) == source(scale));
    s.finished(scale);
    CHECK(s.next(t0 + 450ms) == source(scale));
    s.finished(scale);
    CHECK(s.missed(scale) == 3);  // 200, 300 and 400
    CHECK(s.wake_at() == t0 + 500ms);
}

TEST_CASE("send schedule: a bit sends when it rises")
{
    send_schedule s;
    const auto report = s.add_triggered();
    s.start(t0);
    s.trigger(report, true, t0);  // on at start
    CHECK_FALSE(s.next(t0).has_value());
    s.trigger(report, false, t0);
    CHECK_FALSE(s.next(t0).has_value());
    s.trigger(report, true, t0 + 1s);
    s.trigger(report, true, t0 + 2s);
    CHECK(s.wake_at() == t0 + 1s);
    CHECK(s.next(t0 + 2s) == source(report));
    s.finished(report);
    CHECK_FALSE(s.next(t0 + 3s).has_value());
    CHECK(s.merged(report) == 0);
}

TEST_CASE("send schedule: what is asked for twice before it is sent is sent once; asked for meanwhile, once more")
{
    send_schedule s;
    const auto report = s.add_triggered();
    s.request(report, t0);
    s.request(report, t0);
    CHECK(s.merged(report) == 1);
    CHECK(s.next(t0) == source(report));
    s.request(report, t0);
    CHECK_FALSE(s.next(t0).has_value());
    s.finished(report);
    CHECK(s.next(t0) == source(report));
    s.finished(report);
    CHECK_FALSE(s.next(t0).has_value());
}

TEST_CASE("send schedule: requests and periodic messages take turns, each oldest first")
{
    send_schedule s;
    const auto slow = s.add_periodic(200ms);
    const auto fast = s.add_periodic(100ms);
    const auto first = s.add_triggered();
    const auto second = s.add_triggered();
    s.start(t0);
    s.request(second, t0 + 1ms);
    s.request(first, t0 + 2ms);

    std::vector<std::size_t> order;
    for (time_point now = t0 + 2ms; const auto each = s.next(now); now += 10ms) {
        order.push_back(*each);
        s.finished(*each);
    }
    CHECK(order == std::vector{second, slow, first, fast});
    CHECK(s.next(t0 + 205ms) == source(fast));  // due since 100 ms
}

TEST_SUITE_END();
