#include "bridge/dds/qos_match.hpp"

#include <dds/dds.h>

#include <algorithm>

namespace plcgw {
namespace {

std::vector<dds_data_representation_id_t> representations_of(const dds_qos* qos)
{
    std::uint32_t count = 0;
    dds_data_representation_id_t* values = nullptr;
    if (!dds_qget_data_representation(qos, &count, &values) || count == 0)
        return {DDS_DATA_REPRESENTATION_XCDR1};
    std::vector<dds_data_representation_id_t> all(values, values + count);
    dds_free(values);
    return all;
}

bool is_reliable(const dds_qos* qos)
{
    dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
    dds_duration_t ignored = 0;
    dds_qget_reliability(qos, &kind, &ignored);
    return kind == DDS_RELIABILITY_RELIABLE;
}

dds_durability_kind_t durability_of(const dds_qos* qos)
{
    dds_durability_kind_t kind = DDS_DURABILITY_VOLATILE;
    dds_qget_durability(qos, &kind);
    return kind;
}

dds_duration_t deadline_of(const dds_qos* qos)
{
    dds_duration_t deadline = DDS_INFINITY;
    dds_qget_deadline(qos, &deadline);
    return deadline;
}

bool is_alive_enough(const dds_qos* offered, const dds_qos* requested)
{
    dds_liveliness_kind_t given = DDS_LIVELINESS_AUTOMATIC;
    dds_liveliness_kind_t wanted = DDS_LIVELINESS_AUTOMATIC;
    dds_duration_t given_lease = DDS_INFINITY;
    dds_duration_t wanted_lease = DDS_INFINITY;
    dds_qget_liveliness(offered, &given, &given_lease);
    dds_qget_liveliness(requested, &wanted, &wanted_lease);
    return given >= wanted && given_lease <= wanted_lease;
}

}  // namespace

std::vector<std::string> incompatible_policies(const dds_qos* offered, const dds_qos* requested)
{
    std::vector<std::string> found;
    if (is_reliable(requested) && !is_reliable(offered))
        found.emplace_back("reliability");
    if (durability_of(offered) < durability_of(requested))
        found.emplace_back("durability");
    if (deadline_of(offered) > deadline_of(requested))
        found.emplace_back("deadline");
    if (!is_alive_enough(offered, requested))
        found.emplace_back("liveliness");
    const auto accepted = representations_of(requested);
    if (std::find(accepted.begin(), accepted.end(), representations_of(offered).front()) == accepted.end())
        found.emplace_back("data representation");
    return found;
}

std::vector<std::string> partitions_of(const dds_qos* qos)
{
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(qos, &count, &names))
        return {};
    std::vector<std::string> all(names, names + count);
    for (std::uint32_t i = 0; i < count; ++i)
        dds_free(names[i]);
    dds_free(names);
    return all;
}

}  // namespace plcgw
