// Defaults stand in config.hpp: an empty file gives them, and the schema tells them.
#include "daemon/config/fields.hpp"
#include "daemon/config/schema.hpp"
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <functional>

TEST_SUITE_BEGIN("reader");

using namespace plcgw;
using namespace plcgw::config;
using nlohmann::json;

namespace {

template <class Struct>
json written(Struct& from);

// A visitor of fields.hpp that writes what a struct holds, as the reader would read it.
struct value_writer {
    template <class T, class... Rule>
    void required(const char* key, T& value, const char* description, const Rule&... rule)
    {
        optional(key, value, description, rule...);
    }
    template <class T, class... Rule>
    void optional(const char* key, T& value, const char* /*description*/, const Rule&... rule)
    {
        put(out[key], value, rule...);
    }

    template <class T>
    static void put(json& to, T& value, const text&)
    {
        to = value;
    }
    static void put(json& to, bool value) { to = value; }
    static void put(json& to, unsigned value, const range&) { to = value; }
    static void put(json& to, double value, const real_range&) { to = value; }
    static void put(json& to, const std::vector<unsigned>& value, const range&) { to = value; }
    template <class Period>
    static void put(json& to, std::chrono::duration<std::int64_t, Period> value, const range&)
    {
        to = value.count();
    }
    template <class T, class Rule>
    static void put(json& to, std::optional<T>& value, const Rule& rule)
    {
        if (value)
            put(to, *value, rule);
    }
    template <class Enum, std::size_t N>
    static void put(json& to, Enum value, const choice<Enum> (&choices)[N])
    {
        for (const auto& each : choices)
            if (each.value == value)
                to = each.name;
    }
    template <class Enum, std::size_t N, std::size_t M>
    static void put(json& to, Enum value, const choice<Enum> (&choices)[N], const refusal (&)[M])
    {
        put(to, value, choices);
    }
    template <class Struct>
    static void put(json& to, std::vector<Struct>& rows)
    {
        to = json::array();
        for (Struct& row : rows)
            to.push_back(written(row));
    }
    template <class Struct>
    requires std::is_class_v<Struct>
    static void put(json& to, Struct& value) { to = written(value); }

    json out = json::object();
};

template <class Struct>
json written(Struct& from)
{
    value_writer writer;
    describe(writer, from);
    return writer.out;
}

template <class Struct>
json written_defaults()
{
    Struct defaults;
    return written(defaults);
}

json written_config(std::string_view text)
{
    loaded result = load_text(text, {});
    CHECK(said(result.found) == "");
    return written(result.config);
}

// The "default" of every key in an object's schema.
json schema_defaults(const json& object)
{
    json defaults = json::object();
    for (const auto& [key, property] : object.at("properties").items())
        if (property.contains("default"))
            defaults[key] = property["default"];
        else if (property.contains("properties"))
            defaults[key] = schema_defaults(property);
    return defaults;
}

}  // namespace

TEST_CASE("defaults: an empty file gives the structs as they are")
{
    CHECK(written_config("{}") == written_defaults<gateway_config>());
    CHECK(written_config("// nothing\n{ /* at all */ }\n") == written_defaults<gateway_config>());
    CHECK(written_config(
              R"({"plcs": [], "lines": [], "stations": [], "routes": [], "modbus_tcp": [], "dds": {}, "log": {}})") ==
          written_defaults<gateway_config>());
}

TEST_CASE("defaults: rows with their required keys alone")
{
    const json config = written_config(R"({
        "plcs": [{"name": "a"}],
        "lines": [{"name": "l", "device": "/dev/ttyS0"},
                  {"name": "g", "device": "/dev/ttyS1", "protocol": "general-purpose", "general_purpose": {
                      "received": [{"name": "raw", "plc": "a", "device": "D20", "count": 2}],
                      "messages": [{"name": "m", "plc": "a", "pattern": "{n:number}",
                                    "fields": [{"name": "n", "device": "D30"}]}],
                      "sends": [{"name": "s", "text": "W", "period_ms": 10}]}}],
        "stations": [{"name": "s", "line": "l", "unit": 3}],
        "routes": [{"name": "r", "station": "s", "table": "input", "first": 5, "plc": "a", "device": "D7"}],
        "modbus_tcp": [{"units": [{"unit": 4, "plc": "a"}]}],
        "dds": {"blocks": [{"plc": "a", "device": "D9"}]}})");

    json plc = written_defaults<plc_config>();
    plc["name"] = "a";
    CHECK(config["plcs"][0] == plc);

    json line = written_defaults<line_config>();
    line["name"] = "l";
    line["device"] = "/dev/ttyS0";
    CHECK(config["lines"][0] == line);

    const json& messages = config["lines"][1]["general_purpose"];
    json received = written_defaults<received_config>();
    received.update({{"name", "raw"}, {"plc", "a"}, {"device", "D20"}, {"count", 2}});
    CHECK(messages["received"][0] == received);
    json field = written_defaults<field_config>();
    field.update({{"name", "n"}, {"device", "D30"}});
    json message = written_defaults<message_config>();
    message.update({{"name", "m"}, {"plc", "a"}, {"pattern", "{n:number}"}});
    message["fields"] = json::array({field});
    CHECK(messages["messages"][0] == message);
    json send = written_defaults<send_config>();
    send.update({{"name", "s"}, {"text", "W"}, {"period_ms", 10}});
    CHECK(messages["sends"][0] == send);

    json station = written_defaults<station_config>();
    station["name"] = "s";
    station["line"] = "l";
    station["unit"] = 3;
    CHECK(config["stations"][0] == station);

    json route = written_defaults<route_config>();
    route.update({{"name", "r"}, {"station", "s"}, {"table", "input"}, {"first", 5}, {"plc", "a"}, {"device", "D7"}});
    CHECK(config["routes"][0] == route);

    json server = written_defaults<tcp_server_config>();
    json unit = written_defaults<unit_config>();
    unit.update({{"unit", 4}, {"plc", "a"}});
    server["units"] = json::array({unit});
    CHECK(config["modbus_tcp"][0] == server);

    json block = written_defaults<block_config>();
    block.update({{"plc", "a"}, {"device", "D9"}});
    CHECK(config["dds"]["blocks"][0] == block);
}

TEST_CASE("defaults: the numbers that the manual page and the README tell")
{
    const gateway_config c;
    CHECK(c.gateway == "gateway");
    CHECK(c.dds.settings.enabled);
    CHECK(c.dds.settings.interface == "lo");
    CHECK(c.log.level == log_level::info);
    const line_config line;
    CHECK(line.baud_rate == 19200);
    CHECK(line.check == parity::even);
    CHECK(line.response_timeout == milliseconds(500));
    CHECK(line.retries == 1);
    CHECK(line.low_latency);
    const tcp_server_config server;
    CHECK(server.listen == "127.0.0.1");
    CHECK(server.port == 502);
}

TEST_CASE("defaults: the schema tells those of the structs")
{
    const json root = json::parse(schema());
    const json& all = root.at("properties");
    const auto row = [&](const char* list) { return schema_defaults(all.at(list).at("items")); };

    // Without the required keys and those that have no default.
    const std::function<void(const json&, const json&)> check_subset = [&](const json& told, const json& defaults) {
        CHECK(told.size() >= 1);
        for (const auto& [key, value] : told.items()) {
            INFO(key);
            if (value.is_object())
                check_subset(value, defaults.at(key));
            else
                CHECK(defaults.at(key) == value);
        }
    };
    check_subset(row("plcs"), written_defaults<plc_config>());
    check_subset(row("lines"), written_defaults<line_config>());
    check_subset(row("routes"), written_defaults<route_config>());
    check_subset(row("modbus_tcp"), written_defaults<tcp_server_config>());
    check_subset(schema_defaults(all.at("log")), written_defaults<log_config>());
    json dds = written_defaults<dds_config>();
    check_subset(schema_defaults(all.at("dds")), dds);
    check_subset(row("stations"), written_defaults<station_config>());
    check_subset(row("points"), written_defaults<point_config>());
    CHECK(row("lines").size() == written_defaults<line_config>().size() - 2);  // all but name and device

    // Written out, they change nothing.
    json file = schema_defaults(root);
    file.erase("standby");  // whoever has one gives it a priority
    CHECK(written_config(file.dump()) == written_defaults<gateway_config>());
}

TEST_CASE("defaults: a config that is written out reads the same")
{
    const json once = written_config(plant);
    json file = once;
    file.erase("standby");
    for (auto& station : file["stations"])
        for (const char* key : {"response_timeout_ms", "retries"})
            if (station[key].is_null())
                station.erase(key);
    CHECK(written_config(file.dump()) == once);
    CHECK(once["stations"][0]["retries"] == 0);
    CHECK(once["stations"][1]["retries"].is_null());
    CHECK(once["lines"][0]["parity"] == "none");
    CHECK(once["routes"][1]["direction"] == "write");
    CHECK(once["dds"]["peers"] == json::array({"192.168.1.5"}));
}
