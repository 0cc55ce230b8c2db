#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

void check_stations(check_context& c)
{
    std::map<std::pair<std::string, unsigned>, std::vector<std::string>> users;  // of line and unit: stations so far
    for (std::size_t i = 0; i < c.config.stations.size(); ++i) {
        const station_config& s = c.config.stations[i];
        check_client_line(c, s.line, item("stations", i, "line"));
        if (!c.is_sound(item("stations", i)))
            continue;
        std::vector<std::string>& stations = users[{s.line, s.unit}];
        for (const std::string& other : stations)
            c.complain(item("stations", i, "unit"),
                       "is already the unit id of station \"" + other + "\" on the same line");
        stations.push_back(s.name);
    }
}

}  // namespace plcgw::config
