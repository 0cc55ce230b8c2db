#include "bridge/dds/domain.hpp"

#include "bridge/dds/log_capture.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>

namespace plcgw {

dds_error creation_error(const std::string& what, std::int32_t code, const std::string& logged)
{
    return {fmt::format("cannot create {}: {}", what, logged.empty() ? dds_strretcode(code) : logged)};
}

dds_result<std::shared_ptr<dds_domain>> dds_domain::open(const dds_settings& settings)
{
    // Weak: an address that changed needs a new domain, so the old one must go with its last user.
    static std::map<std::uint32_t, std::weak_ptr<dds_domain>> domains;

    std::string xml = cyclone_xml(settings);
    if (!settings.cyclone_config.empty()) {
        std::ifstream file(settings.cyclone_config);
        xml.assign(std::istreambuf_iterator<char>(file), {});
        if (xml.find('<') == std::string::npos)
            return dds_error{
                fmt::format("{} cannot be read, or is no Cyclone DDS configuration", settings.cyclone_config)};
        xml.erase(0, xml.find('<'));
    }
    auto& slot = domains[settings.domain];
    if (auto domain = slot.lock()) {
        if (domain->xml_ != xml)
            return dds_error{fmt::format("domain {} is in use with other settings", settings.domain)};
        return domain;
    }

    log_capture log;
    const dds_entity_t entity = dds_create_domain(settings.domain, xml.c_str());
    if (entity < 0)
        return creation_error(fmt::format("DDS domain {} {}", settings.domain,
                                          !settings.cyclone_config.empty() ? "as " + settings.cyclone_config + " says"
                                          : settings.interface.empty()     ? "on any interface"
                                                                           : "on interface " + settings.interface),
                              entity, log.text());
    auto domain = std::make_shared<dds_domain>(entity, xml);
    slot = domain;
    return domain;
}

dds_domain::~dds_domain() { dds_delete(entity_); }

dds_result<std::unique_ptr<dds_participant>> dds_participant::open(const dds_settings& settings)
{
    auto domain = dds_domain::open(settings);
    if (!domain)
        return domain.error();
    log_capture log;
    const dds_entity_t entity = dds_create_participant(settings.domain, nullptr, nullptr);
    if (entity < 0)
        return creation_error("DDS participant", entity, log.text());
    return std::make_unique<dds_participant>(*domain, entity);
}

dds_participant::~dds_participant() { dds_delete(entity_); }

void qos_deleter::operator()(dds_qos* qos) const { dds_delete_qos(qos); }

}  // namespace plcgw
