// What refused requests teach, against devices that refuse gaps, lengths, registers and crossings.
#include "bridge/routes/read_plan.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <set>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr wall_time noon{1'700'000'000'000'000'000};

wall_time later(std::chrono::nanoseconds by) { return wall_time{static_cast<std::int64_t>(noon) + by.count()}; }

struct pickiness {
    std::set<std::uint32_t> missing{};
    std::uint32_t longest = 125;
    std::set<std::uint32_t> boundaries{};
    bool always_03 = false;
    bool always_02 = false;
};

// A device, and a gateway that asks it until nothing changes any more.
struct picky_device : pickiness {
    picky_device() = default;
    explicit picky_device(const pickiness& p) : pickiness(p) {}

    std::vector<wanted_read> wanted{};
    station_limits limits{};
    wall_time now = noon;
    int refusals = 0;
    std::set<std::pair<std::uint32_t, std::uint32_t>> refused_before{};
    bool repeated = false;  // a refused request, other than that of one route

    void want(std::uint32_t first, std::uint32_t count, duration period = 1s)
    {
        wanted.push_back(
            {modbus_place{modbus::table::holding_registers, modbus::address{static_cast<std::uint16_t>(first)}}, count,
             period});
    }

    std::optional<station_refusal::cause> answer(const read_block& b) const
    {
        using cause = station_refusal::cause;
        if (b.end - b.first > longest)
            return always_02 ? cause::place : cause::length;
        const auto gone = missing.lower_bound(b.first);
        const auto crossed = boundaries.upper_bound(b.first);
        if ((gone != missing.end() && *gone < b.end) || (crossed != boundaries.end() && *crossed < b.end))
            return always_03 ? cause::length : cause::place;
        return std::nullopt;
    }

    // Asks what is planned. True when something was learned.
    bool round()
    {
        for (const planned_poll& poll : plan_reads(wanted, {}, limits).polls) {
            table_limits& table = limits.tables["holding"];
            const read_block at = block_of(poll);
            const auto why = answer(at);
            if (!why) {
                if (table.accepted(at, now) || table.begin_trial(now))
                    return true;
                continue;
            }
            std::vector<read_block> routes;
            for (const std::size_t i : poll.routes)
                routes.push_back({number(wanted[i].there), number(wanted[i].there) + wanted[i].count});
            const auto lesson = table.refused(at, routes, *why == station_refusal::cause::length, "exception", now);
            ++refusals;
            if (!lesson.blames_routes && !refused_before.insert({at.first, at.end}).second)
                repeated = true;
            if (lesson.learned)
                return true;
        }
        return false;
    }

    void settle()
    {
        for (int i = 0; i < 100 && round(); ++i) {
        }
        refusals = 0;
        CHECK_FALSE(round());
    }

    std::string plan() const
    {
        std::string text;
        for (const planned_poll& poll : plan_reads(wanted, {}, limits).polls)
            text += (text.empty() ? "" : " ") + std::to_string(block_of(poll).first) + "-" +
                    std::to_string(block_of(poll).end - 1);
        return text;
    }
    std::string learned() const
    {
        std::string text;
        for (const auto& [area, table] : limits.tables)
            for (const learned_limit& each : table.all())
                text += (text.empty() ? "" : "; ") + to_string(each, area);
        return text;
    }
};

}  // namespace

TEST_CASE("learned limits: what is refused is found by halving, and nothing else is given up")
{
    const struct {
        const char* name;
        pickiness device;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> routes;  // first, count
        const char* plan;
        const char* learned;
        int still_refused;  // requests of single routes in each round
        int most_refusals;
    } rows[] = {
        {"nothing", {}, {{0, 4}, {6, 4}}, "0-9", "", 0, 0},
        {"a gap", {.missing = {4}}, {{0, 4}, {6, 4}}, "0-3 6-9", "holding 4-5, wanted by no route, is left out", 0, 1},
        {"one gap of four, the last",
         {.missing = {19}},
         {{0, 4}, {5, 4}, {10, 4}, {15, 4}, {20, 4}},
         "0-18 20-23",
         "holding 19, wanted by no route, is left out",
         0,
         3},
        {"a gap, refused with 03",
         {.missing = {4, 5}, .always_03 = true},
         {{0, 4}, {6, 4}, {10, 10}},
         "0-3 6-19",
         "holding 4-5, wanted by no route, is left out",
         0,
         5},
        {"a register of one route, in the middle",
         {.missing = {9}},
         {{0, 4}, {4, 4}, {8, 4}, {12, 4}, {16, 4}},
         "0-7 8-11 12-19",
         "holding 8-11 is asked alone",
         1,
         6},
        {"a register of one route, at the end",
         {.missing = {19}},
         {{0, 4}, {4, 4}, {8, 4}, {12, 4}, {16, 4}},
         "0-15 16-19",
         "holding 16-19 is asked alone",
         1,
         5},
        {"a boundary",
         {.boundaries = {8}},
         {{0, 4}, {4, 4}, {8, 4}, {12, 4}},
         "0-7 8-15",
         "no request goes across holding 8",
         0,
         4},
        {"a boundary, and routes elsewhere that nothing hinders",
         {.boundaries = {10}},
         {{0, 10}, {10, 10}, {100, 10}, {110, 10}},
         "0-9 10-19 100-119",
         "no request goes across holding 10",
         0,
         1},
        {"a length, refused with 02",
         {.longest = 32, .always_02 = true},
         {{0, 10}, {10, 10}, {20, 10}, {30, 10}, {40, 10}, {50, 10}, {60, 10}, {70, 10}, {80, 10}, {90, 10}},
         "0-29 30-59 60-69 70-99",
         "",
         0,
         6},
        {"a length",
         {.longest = 32},
         {{0, 10}, {10, 10}, {20, 10}, {30, 10}, {40, 10}, {50, 10}, {60, 10}, {70, 10}, {80, 10}, {90, 10}},
         "0-29 30-59 60-69 70-99",
         "",
         0,
         4},
        {"a route inside another one, of which a register is missing",
         {.missing = {9}},
         {{0, 12}, {2, 2}},
         "0-11 2-3",
         "holding 0-11 is asked alone",
         1,
         2},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        picky_device device(row.device);
        for (const auto& [first, count] : row.routes)
            device.want(first, count);
        int refusals = 0;
        for (int i = 0; i < 100; ++i) {
            device.refusals = 0;
            const bool learned = device.round();
            refusals += device.refusals;
            if (!learned)
                break;
        }
        CHECK(device.plan() == row.plan);
        if (*row.learned != '\0' || row.still_refused != 0 || device.longest == 125)
            CHECK(device.learned() == row.learned);
        CHECK(device.refusals == row.still_refused);
        CHECK(refusals <= row.most_refusals);
        CHECK_FALSE(device.repeated);
    }
}

TEST_CASE("learned limits: after a day a limit is tried once, and comes back at the first refusal")
{
    picky_device device(pickiness{.missing = {4}});
    device.want(0, 4);
    device.want(6, 4);
    device.settle();
    device.now = later(24h - 1s);
    device.settle();
    CHECK(device.plan() == "0-3 6-9");
    CHECK(device.refusals == 0);

    device.now = later(24h);
    CHECK(device.round());  // the trial
    CHECK(device.plan() == "0-9");
    CHECK(device.round());  // refused
    CHECK(device.plan() == "0-3 6-9");
    device.settle();
    device.now = later(47h);
    device.settle();
    CHECK(device.plan() == "0-3 6-9");

    device.missing.clear();
    device.now = later(49h);
    device.settle();
    CHECK(device.plan() == "0-9");
    CHECK(device.learned().empty());
}

TEST_CASE("learned limits: a device that refuses everything while it starts is read as before a minute later")
{
    picky_device device;
    for (std::uint32_t i = 0; i < 5; ++i)
        device.want(4 * i, 4);
    for (std::uint32_t i = 0; i < 20; ++i)
        device.missing.insert(i);
    device.settle();
    CHECK(device.refusals == 5);
    CHECK(device.plan() == "0-3 4-7 8-11 12-15 16-19");
    device.missing.clear();
    device.now = later(59s);
    device.settle();
    CHECK(device.plan() == "0-3 4-7 8-11 12-15 16-19");
    device.now = later(61s);
    device.settle();
    CHECK(device.plan() == "0-19");
    CHECK(device.learned().empty());
}

TEST_CASE("learned limits: a route that is refused alone, and never was in a larger request, teaches nothing")
{
    table_limits table;
    const auto lesson = table.refused({4, 8}, {{4, 8}}, false, "exception 02", noon);
    CHECK(lesson.blames_routes);
    CHECK_FALSE(lesson.learned);
    CHECK(table.all().empty());
}

TEST_CASE("learned limits: a refusal of what was under way when its limit was learned teaches nothing more")
{
    table_limits table;
    CHECK(table.refused({0, 8}, {{0, 4}, {6, 8}}, false, "exception 02", noon).learned);
    const auto again = table.refused({0, 8}, {{0, 4}, {6, 8}}, false, "exception 02", noon);
    CHECK_FALSE(again.blames_routes);
    CHECK_FALSE(again.learned);
}

TEST_SUITE_END();
