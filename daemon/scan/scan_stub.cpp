// The configuration that a scan leaves behind.
#include "daemon/scan/scan_report.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr std::size_t most_stations = 247;  // of one line that are written down

// Of one exchange, generously: the line is to be half empty with all of them.
constexpr double bits_of_exchange = 60 * 11;
constexpr double pause_s = 0.020;

bool is_bit_area(const std::string& area) { return area == "coil" || area == "discrete" || area == "R" || area == "X"; }

// The scan in which most stations answered; null when none did anywhere.
const json* best_of(const json& scans)
{
    const json* best = nullptr;
    std::size_t most = 0;
    for (const json& scan : scans) {
        const auto here = static_cast<std::size_t>(
            std::count_if(scan["stations"].begin(), scan["stations"].end(),
                          [](const json& each) { return each.value("what", "") != "damaged"; }));
        if (here > most) {
            best = &scan;
            most = here;
        }
    }
    return best;
}

struct stub {
    std::vector<std::string> stations;
    std::vector<std::string> routes;
    unsigned registers = 0;
    unsigned bits = 0;

    void add(const json& found, const std::string& line)
    {
        const unsigned unit = found.value("unit", 0U);
        const std::string name = found.value("name", fmt::format("station{}", unit));
        const std::string identification = found.value("identification", "");
        if (!identification.empty())
            stations.push_back("// " + identification);
        stations.push_back(json{{"name", name}, {"line", line}, {"unit", unit}}.dump());
        for (const json& area : found["areas"])
            if (area.value("says", "") == "values")
                add_route(name, area);
    }

    void add_route(const std::string& name, const json& area)
    {
        const std::string of = area.value("area", "");
        json route{{"name", name + "." + of}, {"station", name}, {"count", 1}, {"plc", "main"}};
        if (area.contains("source")) {
            route["source"] = area["source"];
        }
        else {
            route["table"] = of;
            route["first"] = 0;
        }
        route["device"] = is_bit_area(of) ? fmt::format("M{}", bits++) : fmt::format("D{}", registers++);
        routes.push_back(route.dump());
    }
};

// Comments have lines of their own, and only what is followed by something else has a comma.
std::string rows(const std::vector<std::string>& from, const std::string& more = {})
{
    std::string text;
    std::size_t left = static_cast<std::size_t>(
        std::count_if(from.begin(), from.end(), [](const auto& each) { return !each.starts_with("//"); }));
    for (const std::string& each : from) {
        const bool is_comment = each.starts_with("//");
        text += "    " + (is_comment ? each : each.substr(0, each.size() - 1) + more + "}");
        text += !is_comment && --left != 0 ? ",\n" : "\n";
    }
    return text;
}

unsigned period_ms(const json& line, std::size_t routes)
{
    const double exchange = bits_of_exchange / line.value("baud_rate", 115'200) + pause_s;
    const auto seconds = static_cast<unsigned>(2 * exchange * static_cast<double>(routes)) + 1;
    return 1000 * seconds;
}

}  // namespace

std::string scan_stub(const json& scans)
{
    const json* const scan = best_of(scans);
    const json line = scan == nullptr ? scans.at(0)["line"] : (*scan)["line"];
    stub made;
    if (scan != nullptr)
        for (const json& each : (*scan)["stations"])
            if (each.value("what", "") != "damaged" && made.stations.size() < 2 * most_stations &&
                each.value("unit", 0) != 0)
                made.add(each, line.value("name", ""));
    return fmt::format("// Made by plc-gateway scan. Each route reads the first item of a table that answered, as an "
                       "example:\n// put in what the stations' manuals say. docs: man plc-gateway, README.md\n"
                       "{{\n  \"plcs\": [{{\"name\": \"main\"}}],\n  \"lines\": [\n    {}\n  ],\n"
                       "  \"stations\": [\n{}  ],\n  \"routes\": [\n{}  ]\n}}\n",
                       line.dump(), rows(made.stations),
                       rows(made.routes, fmt::format(",\"period_ms\":{}", period_ms(line, made.routes.size()))));
}

}  // namespace plcgw
