// Which points a change concerns, when they are said, and what becomes of a write.
#include "bridge/points/point_table.hpp"
#include "tests/support/plc_fixture.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <doctest/doctest.h>

#include <random>

TEST_SUITE_BEGIN("points");

using namespace plcgw;
using namespace plcgw::test;

namespace {

struct points_fixture : fx3u_fixture {
    point_table table;
    time_point now = t0;
    wall_time wall{1000};

    point made(const char* name, const char* device, value_type type = value_type::int16)
    {
        point p;
        p.name = name;
        p.plc = &plc;
        p.at = at(device);
        p.form.type = type;
        return p;
    }
    void add(point p) { table.add(std::move(p)); }
    void start()
    {
        table.start(now, wall);
        table.take_samples(now);
    }
    std::vector<point_sample> said()
    {
        for (const plc::change& each : plc.memory().take_changes())
            table.memory_changed(plc, each, wall);
        return table.take_samples(now);
    }
};

}  // namespace

TEST_CASE("points: a change is said of the points that it touches, and of no other")
{
    points_fixture f;
    f.add(f.made("a", "D100", value_type::float32));
    f.add(f.made("b", "D102"));
    f.add(f.made("c", "M5", value_type::boolean));
    f.add(f.made("d", "D50", value_type::text));
    f.start();

    f.set("D101", 1);
    REQUIRE(f.table.find("a") == 0);
    CHECK(f.said().size() == 1);
    f.set("D102", 7);
    f.set_bit("M4", true);
    f.wall = wall_time{2000};
    const auto samples = f.said();
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].name == "b");
    CHECK(samples[0].value == integer_value(7));
    CHECK(samples[0].state == quality::good);
    CHECK(samples[0].source == wall_time{2000});
    f.set_bit("M5", true);
    CHECK(f.said().at(0).value == boolean_value(true));
    CHECK_FALSE(f.table.find("x").has_value());
}

TEST_CASE("points: at the start every point is said")
{
    points_fixture f;
    f.add(f.made("a", "D100"));
    f.add(f.made("b", "D101"));
    f.table.start(t0, wall_time{5});
    CHECK(f.table.take_samples(t0, 1).size() == 1);  // a part at a time
    CHECK(f.table.has_more());
    CHECK(f.table.take_samples(t0).size() == 1);
    CHECK(f.table.take_samples(t0).empty());
}

TEST_CASE("points: the deadband counts from what was said last")
{
    points_fixture f;
    point p = f.made("a", "D100");
    p.deadband = 5;
    f.add(p);
    f.start();
    const std::pair<std::uint16_t, bool> steps[] = {{5, false}, {6, true},  {1, false},
                                                    {0, true},  {5, false}, {6, true}};
    for (const auto& [value, said] : steps) {
        CAPTURE(value);
        f.set("D100", value);
        CHECK(f.said().size() == (said ? 1 : 0));
    }
}

TEST_CASE("points: whatever comes, a reader is never off by more than the deadband")
{
    points_fixture f;
    point p = f.made("a", "D100");
    p.form.scale = 0.5;
    p.deadband = 3;
    f.add(p);
    f.start();
    std::mt19937 random(7);  // NOLINT: the same each time
    double heard = 0;
    std::size_t samples = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto value = static_cast<std::uint16_t>(random() % 100);
        f.set("D100", value);
        for (const point_sample& each : f.said()) {
            heard = each.value.real;
            ++samples;
        }
        REQUIRE(std::abs(value * 0.5 - heard) <= 3);
    }
    CHECK(samples > 100);
    CHECK(samples < 5000);
}

TEST_CASE("points: after the longest silence a point is said again")
{
    points_fixture f;
    point p = f.made("a", "D100");
    p.longest_silence = 10s;
    f.add(p);
    f.add(f.made("never", "D101"));
    f.start();
    const auto said_at = [&f](duration after) {
        f.table.keep_silences(t0 + after);
        return f.table.take_samples(t0 + after).size();
    };
    CHECK(said_at(4s) == 0);
    CHECK(said_at(5s) == 1);  // the first time sooner: points are spread
    CHECK(said_at(14s) == 0);
    CHECK(said_at(15s) == 1);
    CHECK(said_at(16s) == 0);
}

TEST_CASE("points: quality and source time are those of the sources, through copies, too")
{
    points_fixture f;
    plc::simulated_plc other{"other", plc::fx3u, {}};
    source_state pump{quality::never_read, wall_time::never};
    f.table.sources().add("pump", {&f.plc, f.at("D100"), 32}, [&] { return pump; });
    f.table.sources().add_copy({&f.plc, f.at("D101"), 16}, {&other, f.at("D7"), 16});
    f.add(f.made("a", "D100"));
    point copied = f.made("copied", "D7");
    copied.plc = &other;
    f.add(copied);
    f.add(f.made("beside", "D102"));
    f.table.start(t0, f.wall);
    const auto first = f.table.take_samples(t0);
    REQUIRE(first.size() == 3);
    CHECK(first[0].state == quality::never_read);
    CHECK(first[0].value.kind == point_kind::none);
    CHECK(first[1].state == quality::never_read);
    CHECK(first[2].state == quality::good);

    pump = {quality::good, wall_time{77}};
    f.table.source_changed("pump");
    const auto good = f.table.take_samples(t0);
    REQUIRE(good.size() == 2);
    CHECK(good[0].source == wall_time{77});
    CHECK(good[1].name == "copied");
    CHECK(good[1].source == wall_time{77});
    f.table.source_changed("pump");
    CHECK(f.table.take_samples(t0).empty());  // a new time alone is no news

    pump.state = quality::comm_error;
    f.table.source_changed("pump");
    const auto bad = f.table.take_samples(t0);
    REQUIRE(bad.size() == 2);
    CHECK(bad[0].state == quality::comm_error);
    CHECK(bad[0].value == integer_value(0));  // the last known one
}

TEST_CASE("points: values outside the limits")
{
    points_fixture f;
    for (const auto outside : {outside_limits::clamp, outside_limits::reject, outside_limits::uncertain}) {
        point p = f.made(outside == outside_limits::clamp    ? "clamp"
                         : outside == outside_limits::reject ? "reject"
                                                             : "uncertain",
                         "D100");
        p.form.limits = {10, 20, outside};
        f.add(p);
    }
    f.set("D100", 15);
    f.start();
    f.set("D100", 25);
    const auto samples = f.said();
    REQUIRE(samples.size() == 3);
    CHECK(samples[0].value == integer_value(20));
    CHECK(samples[0].state == quality::good);
    CHECK(samples[1].value == integer_value(15));
    CHECK(samples[1].state == quality::out_of_limits);
    CHECK(samples[2].value == integer_value(25));
    CHECK(samples[2].state == quality::out_of_limits);
    f.set("D100", 12);
    for (const point_sample& each : f.said()) {
        CHECK(each.value == integer_value(12));
        CHECK(each.state == quality::good);
    }
}

TEST_CASE("points: a float that is none has no value, and says so")
{
    points_fixture f;
    f.add(f.made("a", "D100", value_type::float32));
    f.start();
    f.set("D100", 0x7FC0);
    const auto samples = f.said();
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].state == quality::no_value);
    CHECK(samples[0].value.kind == point_kind::none);
}

TEST_CASE("points: a write fills all registers at once, or changes nothing")
{
    points_fixture f;
    point p = f.made("set.speed", "D100", value_type::float32);
    p.form.order = byte_order::cdab;
    p.writable = true;
    f.add(p);
    f.add(f.made("speed", "D102"));
    point bit = f.made("run", "D110", value_type::boolean);
    bit.at.bit += 3;
    bit.writable = true;
    f.add(bit);
    f.start();
    CHECK_FALSE(f.table.write("set.speed", real_value(1.5)).has_value());
    CHECK(f.plc.memory().take_changes() == std::vector<plc::change>{{f.at("D100").area, f.at("D100").bit + 16, 16}});
    CHECK(f.word("D100") == 0);
    CHECK(f.word("D101") == 0x3FC0);
    f.set("D110", 0x0100);
    CHECK_FALSE(f.table.write("run", boolean_value(true)).has_value());
    CHECK(f.word("D110") == 0x0108);

    CHECK(f.table.write("set.speed", real_value(1e300))->text ==
          "point \"set.speed\": 1e+300 does not fit the registers of a float");
    CHECK(f.word("D101") == 0x3FC0);
    CHECK(f.table.write("speed", integer_value(1)) ==
          point_refusal{point_fault::read_only,
                        "point \"speed\" is only read: \"writable\" in the configuration allows writing"});
    CHECK(f.table.write("sped", integer_value(1))->why == point_fault::unknown);
}

TEST_CASE("points: of many, a change looks at those it touches alone")
{
    points_fixture f;
    for (unsigned i = 0; i < 7900; ++i)
        f.add(f.made(("p" + std::to_string(i)).c_str(), ("D" + std::to_string(i)).c_str()));
    f.start();
    while (f.table.has_more())
        f.table.take_samples(t0);
    f.set("D4000", 1);
    for (const plc::change& each : f.plc.memory().take_changes())
        f.table.memory_changed(f.plc, each, f.wall);
    CHECK(f.table.take_samples(t0, 1).size() == 1);
    CHECK_FALSE(f.table.has_more());
}

TEST_SUITE_END();
