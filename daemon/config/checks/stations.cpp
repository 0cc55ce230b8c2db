#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

namespace {

unsigned highest_number(line_protocol p)
{
    switch (p) {
    case line_protocol::mewtocol_com: return 99;
    case line_protocol::mewtocol7_com: return 999;
    default: return 247;
    }
}

void check_number(check_context& c, std::size_t i, const station_config& s)
{
    const line_config* const line = c.lines.find(s.line);
    if (line == nullptr)
        return;
    const unsigned highest = highest_number(line->protocol);
    if (s.unit > highest)
        c.complain(item("stations", i, "unit"),
                   "is " + std::to_string(s.unit) + ", but numbers on this line end at " + std::to_string(highest));
    if (s.unit == 0 && line->protocol == line_protocol::mewtocol7_com)
        c.complain(item("stations", i, "unit"), "is 0, but MEWTOCOL7-COM cannot speak to all stations");
}

}  // namespace

void check_stations(check_context& c)
{
    std::map<std::pair<std::string, unsigned>, std::vector<std::string>> users;  // of line and unit: stations so far
    for (std::size_t i = 0; i < c.config.stations.size(); ++i) {
        const station_config& s = c.config.stations[i];
        check_client_line(c, s.line, item("stations", i, "line"));
        if (!c.is_sound(item("stations", i)))
            continue;
        check_number(c, i, s);
        std::vector<std::string>& stations = users[{s.line, s.unit}];
        for (const std::string& other : stations)
            c.complain(item("stations", i, "unit"),
                       "is already the unit id of station \"" + other + "\" on the same line");
        stations.push_back(s.name);
    }
}

}  // namespace plcgw::config
