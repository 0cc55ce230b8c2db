#include "bridge/dds/domain.hpp"

#include "bridge/dds/log_capture.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

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

    const std::string xml = cyclone_xml(settings);
    auto& slot = domains[settings.domain];
    if (auto domain = slot.lock()) {
        if (domain->xml_ != xml)
            return dds_error{fmt::format("domain {} is in use with other settings", settings.domain)};
        return domain;
    }

    log_capture log;
    const dds_entity_t entity = dds_create_domain(settings.domain, xml.c_str());
    if (entity < 0)
        return creation_error(
            fmt::format("DDS domain {} on {}", settings.domain,
                        settings.interface.empty() ? "any interface" : "interface " + settings.interface),
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

qos_ptr partition_qos(const dds_settings& settings)
{
    qos_ptr qos(dds_create_qos());
    const char* name = settings.partition.c_str();
    if (!settings.partition.empty())
        dds_qset_partition(qos.get(), 1, &name);
    return qos;
}

qos_ptr state_qos()
{
    qos_ptr qos(dds_create_qos());
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);  // a write never waits
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
    return qos;
}

qos_ptr event_qos()
{
    constexpr std::int32_t kept = 256;
    qos_ptr qos(dds_create_qos());
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept);
    return qos;
}

qos_ptr request_qos()
{
    constexpr std::int32_t most = 256;
    qos_ptr qos(dds_create_qos());
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
    dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
    dds_qset_resource_limits(qos.get(), most, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    return qos;
}

}  // namespace plcgw
