#include "bridge/plc/model.hpp"
#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

void check_units(check_context& c, const std::string& list, const std::vector<unit_config>& units)
{
    std::set<unsigned> seen;
    for (std::size_t u = 0; u < units.size(); ++u) {
        const std::string at = list + "/" + std::to_string(u);
        if (!units[u].plc.empty())
            c.plc(units[u].plc, at + "/plc");
        if (!units[u].line.empty())
            check_client_line(c, units[u].line, at + "/line");
        if (c.is_sound(at) && units[u].plc.empty() == units[u].line.empty())
            c.complain(at, "leads " + std::string(units[u].plc.empty() ? "nowhere" : "to two places") +
                               ": give either \"plc\" or \"line\"");
        if (c.is_sound(at) && !seen.insert(units[u].unit).second)
            c.complain(at + "/unit", "stands twice: a unit id leads to one place");
    }
}

void check_ascii(check_context& c, const std::string& at, const std::string& plc)
{
    const plc_config* const owner = c.plcs.find(plc);
    const plc::model* const model = owner == nullptr ? nullptr : plc::find_model(owner->model);
    if (model != nullptr && !model->ascii)
        c.complain(at, "is a " + std::string(model->name) + ", which speaks RTU only, on an ASCII line");
}

void check_client_line(check_context& c, const std::string& name, const std::string& at)
{
    const auto* const line = c.line(name, at);
    if (line != nullptr && line->protocol == line_protocol::general_purpose)
        c.complain(at, "is a general-purpose line: nobody can be asked there");
    else if (line != nullptr && line->role != line_role::client)
        c.complain(at, "is a server line: nobody can be asked there");
}

}  // namespace plcgw::config
