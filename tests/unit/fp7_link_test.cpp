// The rules of a PLC link, FP7 manual 6.2.3 and 6.3: its examples, and each way to break them.
#include "bridge/plc_link.hpp"
#include "tests/support/print.hpp"

#include <functional>
#include <string>

TEST_SUITE_BEGIN("services");

using namespace plcgw;

namespace {

// The examples of 6.3.5 and 6.3.6 in one: four stations, the last one only listens.
std::vector<plc_link_station> manual_example()
{
    const auto sends = [](unsigned station, unsigned relay, unsigned relays, unsigned first, unsigned registers) {
        return plc_link_station{station,
                                {.max_station = 4,
                                 .relay_first = relay,
                                 .relay_count = relays,
                                 .register_first = first,
                                 .register_count = registers}};
    };
    return {sends(1, 0, 20, 0, 40), sends(2, 20, 20, 40, 40), sends(3, 40, 24, 80, 48), sends(4, 0, 0, 0, 0)};
}

std::string said(std::span<const plc_link_station> stations)
{
    std::string text;
    for (const plc_link_mistake& m : check_plc_link(stations))
        text.append(text.empty() ? "" : "\n")
            .append(std::to_string(m.index) + " " + std::string(m.setting) + " " + m.text);
    return text;
}

struct mistake_row {
    std::function<void(std::vector<plc_link_station>&)> spoil;
    const char* said;
};

// clang-format off
const mistake_row mistakes[] = {
    {[](auto& s) { s[3].station = 0; },
     "3 station is 0, but a PLC link has the stations 1 to 16"},
    {[](auto& s) { s[3].station = 17; },
     "3 station is 17, but a PLC link has the stations 1 to 16"},
    {[](auto& s) { s[3].station = 5; },
     "3 station is 5, above the highest station of this PLC, which is 4"},
    {[](auto& s) { s[3].station = 2; },
     "3 station is 2 a second time: each station has its own number, and one send area"},
    {[](auto& s) { s[1].settings.block = 2; },
     "1 block is 2, expected 0 to 1"},
    {[](auto& s) { for (auto& each : s) each.settings.max_station = 17; },
     "0 max_station is 17, expected 0 to 16\n"
     "1 max_station is 17, expected 0 to 16\n"
     "2 max_station is 17, expected 0 to 16\n"
     "3 max_station is 17, expected 0 to 16"},
    {[](auto& s) { s[1].settings.max_station = 5; s.resize(2); },
     "1 max_station is 5, but 4 in station 1: it must be the same in all of them"},
    {[](auto& s) { s[0].settings.relay_words = 65; },
     "0 relay_words is 65, expected 0 to 64"},
    {[](auto& s) { s[0].settings.register_words = 129; },
     "0 register_words is 129, expected 0 to 128"},
    {[](auto& s) { s = {{1, {.relay_first = 64}}}; },
     "0 relay_first is 64, expected 0 to 63"},
    {[](auto& s) { s = {{1, {.register_first = 128}}}; },
     "0 register_first is 128, expected 0 to 127"},
    {[](auto& s) { s = {{1, {.register_count = 128}}}; },
     "0 register_count is 128, expected 0 to 127"},
    {[](auto& s) { s = {{1, {.relay_first = 63, .relay_count = 2}}}; },
     "0 relay_count sends WL63-WL64, but this PLC uses only 64 words for the link: raise relay_words"},
    {[](auto& s) { s = {{1, {.register_words = 100, .register_first = 90, .register_count = 11}}}; },
     "0 register_count sends LD90-LD100, but this PLC uses only 100 words for the link: raise register_words"},
    // As the drawing of 6.3.6 shows it between No. 2 and No. 3.
    {[](auto& s) { s[2].settings.relay_first = 39; },
     "2 relay_first sends WL39-WL62, which overlaps with WL20-WL39 of station 2"},
    {[](auto& s) { s[2].settings.register_first = 79; },
     "2 register_first sends LD79-LD126, which overlaps with LD40-LD79 of station 2"},
    {[](auto& s) { s[1].settings.relay_first = 5; s[1].settings.relay_count = 1; },
     "1 relay_first sends WL5-WL5, which overlaps with WL0-WL19 of station 1"},
    {[](auto& s) { s[3].settings.relay_words = 50; },
     "3 relay_words is 50, but station 3 sends WL40-WL63: raise it, it would not be seen here"},
    {[](auto& s) { s[0].settings.register_words = 127; },
     "0 register_words is 127, but station 3 sends LD80-LD127: raise it, it would not be seen here"},
};
// clang-format on

}  // namespace

TEST_CASE("plc link: the manual's examples are right, alone or together")
{
    const auto stations = manual_example();
    CHECK(said(stations) == "");
    for (const plc_link_station& each : stations)
        CHECK(said({&each, 1}) == "");
    CHECK(said({}) == "");
    CHECK(absent_link_stations(stations).empty());
}

TEST_CASE("plc link: each mistake is said once, with the station and what would be right")
{
    for (const mistake_row& row : mistakes) {
        auto stations = manual_example();
        row.spoil(stations);
        CHECK(said(stations) == row.said);
    }
}

TEST_CASE("plc link: sixteen stations with equal shares, and no room for a seventeenth")
{
    std::vector<plc_link_station> stations;
    for (unsigned i = 0; i < 16; ++i)
        stations.push_back(
            {i + 1, {.relay_first = 4 * i, .relay_count = 4, .register_first = 8 * i, .register_count = 8}});
    CHECK(said(stations) == "");
    stations.push_back({17, {}});
    CHECK(said(stations) == "16 station is 17, but a PLC link has the stations 1 to 16");
}

TEST_CASE("plc link: the highest station counts as 16 when it is 0 or 1, and absent ones are named")
{
    CHECK(effective_max_station({.max_station = 0}) == 16);
    CHECK(effective_max_station({.max_station = 1}) == 16);
    CHECK(effective_max_station({.max_station = 2}) == 2);
    auto stations = manual_example();
    stations.erase(stations.begin() + 1);
    CHECK(absent_link_stations(stations) == std::vector<unsigned>{2});
    const plc_link_station alone{3, {.max_station = 0}};
    CHECK(absent_link_stations({&alone, 1}).size() == 15);
    CHECK(said({&alone, 1}) == "");
}

TEST_CASE("plc link: block 1 is the second half of the link memory")
{
    using plc::device;
    using plc::device_kind;
    CHECK(link_relay_word({.block = 0}, 63) == device{device_kind::wl, 63});
    CHECK(link_relay_word({.block = 1}, 0) == device{device_kind::wl, 64});
    CHECK(link_register({.block = 0}, 127) == device{device_kind::ld, 127});
    CHECK(link_register({.block = 1}, 0) == device{device_kind::ld, 128});
}

TEST_SUITE_END();
