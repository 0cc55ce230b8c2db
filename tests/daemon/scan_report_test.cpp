// The lists on the command line of a scan, and what is made of its findings.
#include "daemon/config/read.hpp"
#include "daemon/scan/scan_report.hpp"
#include "daemon/scan/unit_list.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

TEST_SUITE_BEGIN("scan");

using namespace plcgw;
using nlohmann::json;

namespace {

json scan_of(json stations, json line = {{"name", "line1"},
                                         {"protocol", "modbus-rtu"},
                                         {"device", "/dev/ttyUSB0"},
                                         {"baud_rate", 19200},
                                         {"data_bits", 8},
                                         {"parity", "even"},
                                         {"stop_bits", 1}})
{
    return {{"line", std::move(line)}, {"stations", std::move(stations)}, {"state", "done"}, {"disturbed", 0}};
}

json found(unsigned unit, json areas = json::array())
{
    return {{"unit", unit}, {"what", "found"}, {"areas", std::move(areas)}};
}

json damaged(unsigned unit)
{
    return {{"unit", unit}, {"what", "damaged"}, {"reason", "checksum wrong"}, {"areas", json::array()}};
}

json area(const char* name, const char* says, const char* reason = "")
{
    json made{{"area", name}, {"says", says}};
    if (*reason != '\0')
        made["reason"] = reason;
    return made;
}

std::string errors_in(const std::string& text)
{
    std::string all;
    for (const config::mistake& each : config::load_text(text, ".").found)
        all += config::to_string("stub", each) + "\n";
    return all;
}

}  // namespace

TEST_CASE("scan: lists on the command line")
{
    using list = std::vector<unsigned>;
    CHECK(parse_numbers("1-3,9,2", 1, 247) == list{1, 2, 3, 9});
    CHECK(parse_numbers("247", 1, 247) == list{247});
    for (const char* wrong : {"", "0", "248", "3-1", "1-", "-1", "1,,2", "1-300", "x", "1 "})
        CHECK_FALSE(parse_numbers(wrong, 1, 247).has_value());
    const auto formats = parse_formats("8E1,7O2,8N1");
    REQUIRE(formats.has_value());
    CHECK(formats->size() == 3);
    CHECK(to_string((*formats)[1]) == "7O2");
    for (const char* wrong : {"", "9E1", "8X1", "8E3", "8E", "8E11"})
        CHECK_FALSE(parse_formats(wrong).has_value());
    CHECK(parse_protocols("modbus-ascii,mewtocol-com") ==
          std::vector{line_protocol::modbus_ascii, line_protocol::mewtocol_com});
    CHECK_FALSE(parse_protocols("general-purpose").has_value());
}

TEST_CASE("scan: the table says what each unit did")
{
    json meter = found(5, json::array({area("holding", "values"),
                                       area("input", "refused",
                                            "exception 02 (illegal data "
                                            "address)"),
                                       area("coil", "nothing", "no answer")}));
    meter["identification"] = "Acme PM5";
    const json pump{
        {"unit", 1}, {"what", "configured"}, {"name", "pump"}, {"health", "down"}, {"areas", json::array()}};
    CHECK(scan_table(json::array({scan_of(json::array({pump, meter, damaged(9)}))})) ==
          "/dev/ttyUSB0, modbus-rtu, 19200 8E1\n"
          "    1  is station pump, down; it was not asked\n"
          "    5  answers: holding; refuses input exception 02  Acme PM5\n"
          "    9  sent something, damaged: checksum wrong\n");
    CHECK(scan_table(json::array({scan_of(json::array())})) == "no station answered\n");
    CHECK(stations_in(json::array({scan_of(json::array({pump, meter, damaged(9)}))})) == 2);
}

TEST_CASE("scan: hints")
{
    const auto hints = [](json stations) { return scan_hints(json::array({scan_of(std::move(stations))})); };
    CHECK(hints(json::array({found(1)})).empty());
    REQUIRE(hints(json::array({damaged(1)})).size() == 1);
    CHECK(hints(json::array({damaged(1)}))[0].find("another baud rate or parity?") != std::string::npos);
    CHECK(hints(json::array({found(1), damaged(2)}))[0].find("two stations with one unit id") != std::string::npos);
    json all = json::array();
    for (unsigned unit = 0; unit < 256; ++unit)
        all.push_back(found(unit));
    CHECK(hints(all)[0].find("does not look at them") != std::string::npos);
    json disturbed = scan_of(json::array());
    disturbed["disturbed"] = 3;
    CHECK(scan_hints(json::array({disturbed}))[0].find("3 units could not be asked") != std::string::npos);
}

TEST_CASE("scan: the stub is a configuration without mistakes")
{
    const json values = json::array({area("holding", "values"), area("coil", "values"), area("input", "refused")});
    json meter = found(5, values);
    meter["identification"] = "Acme \"PM5\" // */";
    json every = json::array();
    for (unsigned unit = 1; unit <= 247; ++unit)
        every.push_back(found(unit, values));
    const json tcp{{"name", "line1"}, {"protocol", "modbus-tcp"}, {"host", "10.0.0.1"}, {"port", 502}};
    const json slow{{"name", "line1"}, {"protocol", "modbus-rtu"}, {"device", "/dev/ttyS0"}, {"baud_rate", 1200},
                    {"data_bits", 8},  {"parity", "none"},         {"stop_bits", 1}};
    const json mewtocol{{"name", "line1"},        {"protocol", "mewtocol-com"},
                        {"device", "/dev/ttyS0"}, {"baud_rate", 9600},
                        {"data_bits", 8},         {"parity", "odd"},
                        {"stop_bits", 1}};
    json fp7 = found(7, json::array({area("DT", "values"), area("X", "values")}));
    fp7["areas"][0]["source"] = "DT0";
    fp7["areas"][1]["source"] = "X0";
    const json rows[] = {
        json::array({scan_of(json::array({meter, damaged(6), found(8)}))}),
        json::array({scan_of(json::array()), scan_of(json::array({found(0), found(1, values)}), tcp)}),
        json::array({scan_of(every, slow)}),
        json::array({scan_of(json::array({fp7}), mewtocol)}),
        json::array({scan_of(json::array())}),
    };
    for (const json& row : rows) {
        const std::string stub = scan_stub(row);
        CAPTURE(stub);
        CHECK(errors_in(stub).empty());
    }
    const auto made = config::load_text(scan_stub(rows[0]), ".").config;
    REQUIRE(made.stations.size() == 2);
    CHECK(made.stations[0].unit == 5);
    REQUIRE(made.routes.size() == 2);
    CHECK(made.routes[1].device == "M0");
    CHECK(config::load_text(scan_stub(rows[1]), ".").config.lines[0].host == "10.0.0.1");
}
