// Points on the wire and for people.
#include "bridge/dds/event_table.hpp"
#include "bridge/dds/event_text.hpp"
#include "daemon/event_json.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr wall_time t0{1'700'000'000'000'000'000};

received_point heard(point_value value, quality state = quality::good)
{
    return {"gw", "m1", 1, code_of(state), "boiler.temp", std::move(value), state, t0, "Cel"};
}

}  // namespace

TEST_CASE("dds: a late subscriber gets the last value of every point, of every kind")
{
    auto out = dds_publisher::create(own_domain(), identity("gw"));
    REQUIRE_MESSAGE(out.has_value(), out.error().text);
    const struct {
        const char* name;
        point_value value;
        quality state;
    } rows[] = {
        {"on", boolean_value(true), quality::good},
        {"count", integer_value(-9'007'199'254'740'993), quality::good},
        {"temp", real_value(21.5), quality::substituted},
        {"tag", text_value("Kessel \xC3\xBC"), quality::out_of_limits},
        {"none", {}, quality::no_value},
    };
    for (const auto& row : rows)
        for (int i = 0; i < 2; ++i)
            out->publish(point_sample{row.name, "Cel", row.value, row.state, t0});
    CHECK(out->drops() == 0);

    auto in = dds_subscriber::create(own_domain());
    REQUIRE_MESSAGE(in.has_value(), in.error().text);
    std::vector<dds_event> events;
    REQUIRE(collect(*in, events, [](const auto& all) { return only<received_point>(all).size() >= 5; }));
    for (const auto& row : rows) {
        bool found = false;
        for (const received_point& each : only<received_point>(events)) {
            if (each.name != row.name)
                continue;
            found = true;
            CHECK(each.value == row.value);
            CHECK(each.state == row.state);
            CHECK(each.code == code_of(row.state));
            CHECK(each.seq == 2);
            CHECK(each.gateway == "gw");
            CHECK(each.member == "member-1");
            CHECK(each.unit == "Cel");
            CHECK(each.source == t0);
        }
        CHECK_MESSAGE(found, row.name);
    }
}

TEST_CASE("quality codes: new ones, uncertain and bad")
{
    CHECK(code_of(quality::substituted) == 72);
    CHECK(code_of(quality::out_of_limits) == 84);
    CHECK(code_of(quality::no_value) == 16);
}

TEST_CASE("event text: points")
{
    CHECK(line_of(heard(real_value(21.5))) == "2023-11-14T22:13:20.000Z gw boiler.temp good: 21.5 Cel");
    CHECK(line_of(heard(integer_value(-3), quality::substituted)) ==
          "2023-11-14T22:13:20.000Z gw boiler.temp substituted: -3 Cel");
    CHECK(value_text(heard(boolean_value(true))) == "on");
    CHECK(value_text(heard(text_value("a\x1b[2J"))) == "a?[2J");
    CHECK(value_text(heard({}, quality::no_value)) == "-");
    CHECK(line_of(gone_point{"gw", "boiler.temp", gone_reason::writer_lost}) == "- gw boiler.temp gone: writer lost");
}

TEST_CASE("event json: points")
{
    const auto object = nlohmann::json::parse(json_line(heard(real_value(21.5))));
    CHECK(object["event"] == "point");
    CHECK(object["value"] == 21.5);
    CHECK(object["kind"] == "real");
    CHECK(object["quality_code"] == 192);
    CHECK(nlohmann::json::parse(json_line(heard({}, quality::never_read)))["value"].is_null());
    CHECK(nlohmann::json::parse(json_line(heard(boolean_value(true))))["value"] == true);
}

TEST_CASE("event table: points, until their gateway is gone")
{
    event_table table;
    CHECK(table.apply(heard(real_value(21.5)), t0));
    CHECK_FALSE(table.apply(heard(real_value(21.5)), t0));
    CHECK(table.apply(heard(real_value(22), quality::out_of_limits), t0));
    auto lines = table.lines(t0, 90, 24);
    REQUIRE(lines.size() == 4);
    CHECK(lines[2].text.starts_with("  POINT"));
    CHECK(lines[3] ==
          table_line{line_style::warning, "! boiler.temp                             out of limits   0.0 s  22 Cel"});
    CHECK(table.apply(gone_point{"gw", "boiler.temp", gone_reason::writer_lost}, t0));
    lines = table.lines(t0, 90, 24);
    CHECK(lines[3].style == line_style::old);
}
