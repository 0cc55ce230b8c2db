// QoS of every topic: what dds.md found safe, and what a site may change of it.
#include "bridge/dds/domain.hpp"
#include "messages.h"
#include "registers.h"

#include <dds/dds.h>

namespace plcgw {
namespace {

// More than a writer keeps: what came while we were drawing is still there.
constexpr std::int32_t kept_by_reader = 8192;

}  // namespace

qos_ptr partition_qos(const dds_settings& settings)
{
    std::vector<const char*> names;
    if (!settings.partition.empty())
        names.push_back(settings.partition.c_str());
    for (const std::string& each : settings.partitions)
        names.push_back(each.c_str());
    qos_ptr qos(dds_create_qos());
    if (!names.empty())
        dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
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

const dds_topic_descriptor_t& type_of(dds_topic which)
{
    switch (which) {
    case dds_topic::serial_message: return plcgw_v1_SerialMessage_desc;
    case dds_topic::event: return plcgw_v1_Event_desc;
    case dds_topic::register_block: return plcgw_v1_RegisterBlock_desc;
    case dds_topic::point: return plcgw_v1_Point_desc;
    case dds_topic::port_status: return plcgw_v1_PortStatus_desc;
    case dds_topic::device_status: return plcgw_v1_DeviceStatus_desc;
    case dds_topic::gateway_status: break;
    }
    return plcgw_v1_GatewayStatus_desc;
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

// The one place for what the gateway's writers offer.
qos_ptr writer_qos(const dds_settings& settings, dds_topic which)
{
    const topic_settings& set = settings.topic(which);
    qos_ptr qos = is_state(which) ? state_qos() : event_qos();
    if (set.reliability == dds_reliability::best_effort)
        dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    if (set.deadline.count() > 0)
        dds_qset_deadline(qos.get(), DDS_MSECS(set.deadline.count()));
    if (!is_state(which) && set.history > 0)
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, static_cast<std::int32_t>(set.history));
    // Fast DDS 2.x knows XCDR1 only. Values stay when the gateway ends: it did not dispose of the registers.
    const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &xcdr1);
    dds_qset_writer_data_lifecycle(qos.get(), false);
    return qos;
}

qos_ptr reader_qos(const dds_settings& settings, dds_topic which)
{
    qos_ptr qos = is_state(which) ? state_qos() : event_qos();
    if (settings.topic(which).reliability == dds_reliability::best_effort)
        dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    if (!is_state(which))
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept_by_reader);
    return qos;
}

std::string_view policy_name(std::uint32_t policy)
{
    switch (policy) {
    case DDS_DURABILITY_QOS_POLICY_ID: return "durability";
    case DDS_PRESENTATION_QOS_POLICY_ID: return "presentation";
    case DDS_DEADLINE_QOS_POLICY_ID: return "deadline";
    case DDS_LATENCYBUDGET_QOS_POLICY_ID: return "latency budget";
    case DDS_OWNERSHIP_QOS_POLICY_ID: return "ownership";
    case DDS_LIVELINESS_QOS_POLICY_ID: return "liveliness";
    case DDS_RELIABILITY_QOS_POLICY_ID: return "reliability";
    case DDS_DESTINATIONORDER_QOS_POLICY_ID: return "destination order";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID: return "data representation";
    default: return "QoS policy";
    }
}

}  // namespace plcgw
