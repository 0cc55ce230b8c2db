#include "daemon/config/check.hpp"

#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {
namespace {

template <class Row>
void unique_names(check_context& c, const char* list, const std::vector<Row>& rows)
{
    std::set<std::string> seen;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!rows[i].name.empty() && !seen.insert(rows[i].name).second)
            c.complain(item(list, i, "name"), "\"" + rows[i].name + "\" stands twice: give each its own name");
}

}  // namespace

void check(const gateway_config& c, const located_json& file, const std::string& folder, mistakes& found)
{
    check_context context(c, file, folder, found);
    unique_names(context, "plcs", c.plcs);
    unique_names(context, "lines", c.lines);
    unique_names(context, "stations", c.stations);
    unique_names(context, "routes", c.routes);
    unique_names(context, "points", c.points);
    check_plcs(context);
    check_lines(context);
    check_channel_users(context);
    check_stations(context);
    device_check devices(context);
    device_users users;
    check_routes(context, devices, users);
    check_messages(context, devices, users.filled);
    check_points(context, devices, users);
    check_servers(context);
    check_plc_links(context);
    check_dds(context);
    check_standby(context);
}

}  // namespace plcgw::config
