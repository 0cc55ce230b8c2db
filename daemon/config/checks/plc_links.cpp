#include "bridge/plc/models/fp7.hpp"
#include "daemon/config/checks/checks.hpp"

#include <map>
#include <utility>

namespace plcgw::config {
namespace {

constexpr auto list = "plc_links";

// Each PLC has the link relays and link registers of two blocks: for one link each.
void check_plc_of(check_context& c, std::size_t i, std::map<std::pair<std::string, unsigned>, std::size_t>& taken)
{
    const plc_link_config& l = c.config.plc_links[i];
    const plc_config* const owner = c.plc(l.plc, item(list, i, "plc"));
    if (owner == nullptr || !c.is_sound(item(list, i)))
        return;
    // A model that could not be read has a default in its place.
    const auto row = static_cast<std::size_t>(owner - c.config.plcs.data());
    const plc::model* const model = c.is_sound(item("plcs", row)) ? c.model_of(l.plc) : nullptr;
    if (model != nullptr && model != &plc::fp7)
        c.complain(item(list, i, "plc"), "names \"" + l.plc + "\", a " + std::string(model->name) +
                                             ": only an FP7 has link relays and link registers");
    for (std::size_t before = 0; before < i; ++before)
        if (c.config.plc_links[before].name == l.name && c.config.plc_links[before].plc == l.plc) {
            c.complain(item(list, i, "plc"), "names \"" + l.plc + "\", which is a station of this link already");
            return;
        }
    const auto [where, fresh] = taken.try_emplace({l.plc, l.as.settings.block}, i);
    if (!fresh)
        c.complain(item(list, i, "block"), "is " + std::to_string(l.as.settings.block) + ", which the link \"" +
                                               c.config.plc_links[where->second].name + "\" uses in \"" + l.plc +
                                               "\": each link has a block of its own");
}

// Stations of one link in this gateway. Those of other gateways are seen when it runs.
void check_stations_of(check_context& c, const std::vector<std::size_t>& rows)
{
    std::vector<plc_link_station> stations;
    for (const std::size_t i : rows)
        stations.push_back(c.config.plc_links[i].as);
    for (const plc_link_mistake& m : check_plc_link(stations))
        c.complain(item(list, rows[m.index], std::string(m.setting).c_str()), m.text);
}

}  // namespace

void check_plc_links(check_context& c)
{
    std::map<std::string, std::vector<std::size_t>> links;
    std::map<std::pair<std::string, unsigned>, std::size_t> taken;
    for (std::size_t i = 0; i < c.config.plc_links.size(); ++i) {
        check_plc_of(c, i, taken);
        if (c.is_sound(item(list, i)))
            links[c.config.plc_links[i].name].push_back(i);
    }
    for (const auto& [name, rows] : links)
        check_stations_of(c, rows);
    if (!c.config.plc_links.empty() && !c.config.dds.settings.enabled)
        c.complain("/dds/enabled", "is false, but DDS is what carries the PLC links: switch it on or remove them");
}

}  // namespace plcgw::config
