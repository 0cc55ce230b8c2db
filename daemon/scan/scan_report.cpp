#include "daemon/scan/scan_report.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr std::size_t too_many = 200;  // units that answer: a server that does not look at them

std::string settings_of(const json& line)
{
    const bool is_serial = line.contains("device");
    std::string text =
        is_serial ? line.value("device", "") : fmt::format("{}:{}", line.value("host", ""), line.value("port", 0));
    text += ", " + line.value("protocol", "");
    if (!line.contains("baud_rate"))
        return text;
    const std::string check = line.value("parity", "none");
    return text + fmt::format(", {} {}{}{}", line.value("baud_rate", 0), line.value("data_bits", 8),
                              check == "none"  ? 'N'
                              : check == "odd" ? 'O'
                                               : 'E',
                              line.value("stop_bits", 1));
}

std::string areas_of(const json& station, const char* says)
{
    std::string text;
    for (const json& each : station["areas"]) {
        if (each.value("says", "") != says)
            continue;
        const std::string reason = each.value("reason", "");
        text.append(text.empty() ? "" : ", ").append(each.value("area", ""));
        if (!reason.empty() && std::string(says) == "refused")
            text.append(" ").append(reason.substr(0, reason.find(" (")));
    }
    return text;
}

std::string described(const json& station)
{
    if (station.value("what", "") == "configured")
        return fmt::format("is station {}, {}; it was not asked", station.value("name", ""),
                           station.value("health", ""));
    if (station.value("what", "") == "damaged")
        return "sent something, damaged: " + station.value("reason", "");
    const std::string values = areas_of(station, "values");
    const std::string refused = areas_of(station, "refused");
    std::string text = "answers";
    text += values.empty() ? "" : ": " + values;
    text += refused.empty() ? "" : (values.empty() ? ": " : "; ") + std::string("refuses ") + refused;
    const std::string name = station.value("name", "");
    text += name.empty() ? "" : "; station " + name;
    const std::string identification = station.value("identification", "");
    return text + (identification.empty() ? "" : "  " + identification);
}

std::size_t count(const json& scan, const char* what)
{
    return static_cast<std::size_t>(std::count_if(scan["stations"].begin(), scan["stations"].end(),
                                                  [what](const json& each) { return each.value("what", "") == what; }));
}

void add_hints(std::vector<std::string>& hints, const json& scan)
{
    const std::string where = settings_of(scan["line"]);
    const std::size_t found = count(scan, "found");
    const std::size_t damaged = count(scan, "damaged");
    if (damaged != 0 && found == 0)
        hints.push_back(where + ": something is there, but its answers are damaged: another baud rate or parity?");
    if (damaged != 0 && found != 0)
        hints.push_back(where + ": damaged answers beside good ones: two stations with one unit id, stations with "
                                "another baud rate or parity, or a bad line");
    if (const std::size_t disturbed = scan.value("disturbed", std::size_t{0}); disturbed != 0)
        hints.push_back(fmt::format("{}: {} units could not be asked, somebody else kept talking: another client on "
                                    "the line?",
                                    where, disturbed));
    if (found >= too_many)
        hints.push_back(where + ": nearly every unit id is answered: the server does not look at them, it is one "
                                "station");
}

}  // namespace

std::size_t stations_in(const json& scans)
{
    std::size_t all = 0;
    for (const json& each : scans)
        all += count(each, "found") + count(each, "configured");
    return all;
}

std::string scan_table(const json& scans)
{
    std::string text;
    for (const json& scan : scans) {
        if (scan["stations"].empty())
            continue;
        text += settings_of(scan["line"]) + "\n";
        for (const json& each : scan["stations"])
            text += fmt::format("{:>5}  {}\n", each.value("unit", 0), described(each));
    }
    return text.empty() ? "no station answered\n" : text;
}

std::vector<std::string> scan_hints(const json& scans)
{
    std::vector<std::string> hints;
    for (const json& each : scans)
        add_hints(hints, each);
    return hints;
}

}  // namespace plcgw
