#include "daemon/control_command.hpp"

#include "daemon/plc_link_command.hpp"

#include <nlohmann/json.hpp>

namespace plcgw {

nlohmann::json control_command(const plc_list& plcs, const plc_links* links, const nlohmann::json& what, time_point now)
{
    return what.value("command", "") == "plc-link" ? plc_link_command(links, now) : plc_command(plcs, what);
}

}  // namespace plcgw
