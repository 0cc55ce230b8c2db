// What becomes of requests that are repeated, that come too late, or that mean nothing.
#include "bridge/orders/order_log.hpp"
#include "bridge/orders/order_targets.hpp"
#include "tests/support/plc_fixture.hpp"
#include "tests/support/virtual_time.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("orders");

using namespace plcgw;
using namespace plcgw::test;

namespace {

const order_outcome fine{order_result::ok, 0, "done"};
const order_key k1{"panel", 1};
constexpr auto active = order_log::role::active;
constexpr auto standby = order_log::role::standby;

route_order part(const char* area, std::uint32_t first, order_values values)
{
    return {"r", area, first, std::move(values)};
}
order_values some_words(std::vector<std::uint16_t> w)
{
    return {false, static_cast<std::uint32_t>(w.size()), std::move(w)};
}

struct route_bench : fx3u_fixture {
    route r = route_to("D100", modbus::table::holding_registers, 20, 10, direction::write);
    order_result refused(const route_order& o) const
    {
        const auto span = part_of(r, o);
        REQUIRE_FALSE(span.has_value());
        CHECK_FALSE(span.error().detail.empty());
        return span.error().result;
    }
};

}  // namespace

TEST_CASE("order log: a request is executed once, ignored while it is under way, and answered again when it is done")
{
    order_log log;
    CHECK(log.came(k1, active).execute);
    const auto again = log.came(k1, active);
    CHECK_FALSE(again.execute);
    CHECK_FALSE(again.answer);
    log.done(k1, fine);
    const auto after = log.came(k1, active);
    CHECK_FALSE(after.execute);
    CHECK(after.answer == fine);
    CHECK(log.came({"panel", 2}, active).execute);
    CHECK(log.came({"other", 1}, active).execute);
}

TEST_CASE("order log: it is bounded, and forgets nothing that is under way")
{
    order_log log(4, 2);
    CHECK(log.came(k1, active).execute);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const order_key key{"many", i};
        CHECK(log.came(key, active).execute);
        log.done(key, fine);
        CHECK(log.size() <= 4);
    }
    CHECK_FALSE(log.came(k1, active).execute);
    CHECK(log.came({"many", 99}, active).answer == fine);
    CHECK(log.came({"x", 1}, active).execute);
    CHECK(log.came({"x", 2}, active).answer->result == order_result::busy);
    log.done(k1, fine);
    CHECK(log.came({"x", 2}, active).execute);
}

TEST_CASE("order log: what a standby saw is not executed after it has taken over")
{
    order_log log;
    CHECK_FALSE(log.came(k1, standby).execute);
    CHECK_FALSE(log.came(k1, standby).answer);
    log.heard(k1, fine);
    CHECK_FALSE(log.came(k1, standby).answer);  // the other one answers
    CHECK(log.came(k1, active).answer == fine);

    const order_key unanswered{"panel", 2};
    log.came(unanswered, standby);
    const auto after = log.came(unanswered, active);
    CHECK_FALSE(after.execute);
    REQUIRE(after.answer);
    CHECK(after.answer->result == order_result::timeout);
    log.heard(unanswered, fine);  // late
    CHECK(log.came(unanswered, active).answer == fine);

    const order_key lost{"panel", 3};  // the request was lost, its reply was not
    log.heard(lost, fine);
    CHECK_FALSE(log.came(lost, active).execute);
    CHECK(log.came({"panel", 4}, active).execute);
}

TEST_CASE("order log: a reply of another does not touch what is under way here")
{
    order_log log;
    log.came(k1, active);
    log.heard(k1, {order_result::busy, 0, ""});
    CHECK_FALSE(log.came(k1, active).answer);
    log.done(k1, fine);
    CHECK(log.came(k1, active).answer == fine);
}

TEST_CASE("order log: what was under way when the role was lost is the other member's to answer")
{
    order_log log(4, 1);
    CHECK(log.came(k1, active).execute);
    log.given_up(k1);
    CHECK(log.under_way() == 0);
    CHECK_FALSE(log.came(k1, standby).answer);
    CHECK(log.came(k1, active).answer->result == order_result::timeout);  // active again, and nothing was heard

    const order_key answered{"panel", 2};
    CHECK(log.came(answered, active).execute);
    log.heard(answered, {order_result::timeout, 0, "as the other one says"}, wall_time{18});
    log.given_up(answered);
    log.given_up(answered);
    CHECK(log.under_way() == 0);
    CHECK_FALSE(log.came(answered, active).execute);
    CHECK(log.came(answered, active).answer->detail == "as the other one says");
    CHECK(log.came(answered, active).done == wall_time{18});
    CHECK(log.came({"panel", 3}, active).execute);
}

TEST_CASE("order log: a repeated answer says when it was done, here or by another member")
{
    order_log log;
    log.came(k1, active);
    log.done(k1, fine, wall_time{17});
    CHECK(log.came(k1, active).done == wall_time{17});
    log.heard({"panel", 9}, fine, wall_time{18});
    CHECK(log.came({"panel", 9}, active).done == wall_time{18});
    log.came({"panel", 10}, order_log::role::standby);
    CHECK(log.came({"panel", 10}, active).done == wall_time::never);
}

TEST_CASE("orders: until when they may begin")
{
    constexpr std::int64_t noon = 1'700'000'000'000'000'000;
    struct row {
        const char* what;
        std::int64_t given;
        duration timeout;
        duration left;
    };
    const row rows[] = {
        {"nobody says when: from now", 0, 300ms, 300ms},
        {"no timeout: a generous one", 0, 0ms, 10s},
        {"its way counts", noon - 100'000'000, 300ms, 200ms},
        {"too late", noon - 400'000'000, 300ms, -100ms},
        {"a clock that is ahead", noon + 5'000'000'000, 300ms, 300ms},
        {"nonsense", std::numeric_limits<std::int64_t>::min(), 300ms, 300ms},
        {"nonsense too", std::numeric_limits<std::int64_t>::max(), 300ms, 300ms},
    };
    for (const row& each : rows) {
        CAPTURE(each.what);
        const order o{point_order{}, wall_time{each.given}, each.timeout};
        CHECK(begin_by(o, t0, wall_time{noon}) - t0 == each.left);
    }
}

TEST_CASE("orders: which part of a route is meant")
{
    route_bench b;
    const auto span = part_of(b.r, part("holding", 22, some_words({1, 2, 3})));
    REQUIRE(span.has_value());
    CHECK(span->at == b.at("D102"));
    CHECK(span->bits == 48);
    CHECK(part_of(b.r, part("holding", 20, some_words(std::vector<std::uint16_t>(10)))).has_value());

    CHECK(b.refused(part("holding", 19, some_words({1}))) == order_result::rejected);
    CHECK(b.refused(part("holding", 29, some_words({1, 2}))) == order_result::rejected);
    CHECK(b.refused(part("holding", 0xFFFFFFFF, some_words({1, 2}))) == order_result::rejected);
    CHECK(b.refused(part("input", 20, some_words({1}))) == order_result::rejected);
    CHECK(b.refused(part("holding", 20, {true, 1, {1}})) == order_result::rejected);
    CHECK(b.refused(part("holding", 20, {false, 2, {1}})) == order_result::rejected);
    CHECK(b.refused(part("holding", 20, {})) == order_result::rejected);
    b.r.way = direction::read;
    CHECK(b.refused(part("holding", 20, some_words({1}))) == order_result::rejected);
    b.r = b.route_to("D8400", modbus::table::holding_registers, 20, 10, direction::write);
    b.plc.memory().set_protected(b.at("D8402"), 16, true);
    CHECK(b.refused(part("holding", 20, some_words({1, 2, 3}))) == order_result::rejected);
    CHECK(part_of(b.r, part("holding", 20, some_words({1}))).has_value());
}

TEST_CASE("orders: bits of a route, and devices of a PLC by name")
{
    route_bench b;
    b.r = b.route_to("M100", modbus::table::coils, 0, 20, direction::write);
    const auto span = part_of(b.r, part("coil", 3, {true, 17, {0xFFFF, 1}}));
    REQUIRE(span.has_value());
    CHECK(span->at == b.at("M103"));
    CHECK(span->bits == 17);
    memory_write written(*span);
    written.write({true, 17, {0x8001, 1}});
    CHECK(b.plc.memory().bit(b.at("M103")));
    CHECK_FALSE(b.plc.memory().bit(b.at("M104")));
    CHECK(b.plc.memory().bit(b.at("M118")));
    CHECK(b.plc.memory().bit(b.at("M119")));

    CHECK(devices_of(b.plc, {"main", "D7999", some_words({1})}).has_value());
    const auto result = [&](device_order o) { return devices_of(b.plc, o).error().result; };
    CHECK(result({"main", "D7999", some_words({1, 2})}) == order_result::rejected);
    CHECK(result({"main", "D99999", some_words({1})}) == order_result::not_found);
    CHECK(result({"main", "Q1", some_words({1})}) == order_result::not_found);
    CHECK(result({"main", "M1", some_words({1})}) == order_result::rejected);
    CHECK(result({"main", "D1", {true, 1, {1}}}) == order_result::rejected);
}

TEST_SUITE_END();
