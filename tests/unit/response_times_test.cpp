#include "bridge/routes/response_times.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

response_times after(std::initializer_list<duration> answers, int rounds)
{
    response_times times;
    for (int i = 0; i < rounds; ++i)
        for (const duration each : answers)
            times.add(each);
    return times;
}

}  // namespace

TEST_CASE("response times: a few answers are not enough for a timeout")
{
    CHECK(response_times().timeout(50ms, 500ms) == 500ms);
    CHECK_FALSE(response_times().mean().has_value());
    CHECK(after({5ms}, 7).timeout(50ms, 500ms) == 500ms);
    CHECK(after({5ms}, 8).timeout(50ms, 500ms) < 500ms);
}

TEST_CASE("response times: the timeout is that of the station, within the bounds")
{
    CHECK(after({5ms}, 100).timeout(50ms, 500ms) == 50ms);
    CHECK(after({5ms}, 100).timeout(1ms, 500ms) < 6ms);
    CHECK(after({100ms}, 100).timeout(50ms, 500ms) < 110ms);
    CHECK(after({2s}, 100).timeout(50ms, 500ms) == 500ms);
    CHECK(after({2s}, 100).timeout(600ms, 500ms) == 500ms);  // bounds that exclude each other
    CHECK(after({5ms}, 100).mean() == 5ms);
}

TEST_CASE("response times: a station whose answers vary gets time for the slow ones")
{
    const response_times times = after({10ms, 12ms, 90ms, 11ms}, 100);
    CHECK(times.timeout(20ms, 500ms) > 100ms);
    CHECK(times.timeout(20ms, 500ms) < 250ms);
}

TEST_SUITE_END();
