#include "bridge/dds/discovery.hpp"

#include "bridge/dds/domain.hpp"
#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/qos_match.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fnmatch.h>
#include <optional>

namespace plcgw {
namespace {

using guid = std::array<std::uint8_t, 16>;

guid guid_of(const dds_guid_t& from)
{
    guid out;
    std::copy(std::begin(from.v), std::end(from.v), out.begin());
    return out;
}

std::string property(const dds_qos_t* qos, const char* name)
{
    char* value = nullptr;
    if (!dds_qget_prop(qos, name, &value) || value == nullptr)
        return {};
    std::string text = value;
    dds_free(value);
    return text;
}

std::optional<dds_topic> topic_of(const char* name)
{
    for (std::size_t i = 0; i < dds_topics; ++i)
        if (std::strcmp(name, topic_name(static_cast<dds_topic>(i))) == 0)
            return static_cast<dds_topic>(i);
    return std::nullopt;
}

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

// No partition is the one with the empty name.
bool shares_partition(std::vector<std::string> ours, std::vector<std::string> theirs)
{
    if (ours.empty())
        ours.emplace_back();
    if (theirs.empty())
        theirs.emplace_back();
    return std::ranges::any_of(ours, [&](const std::string& one) {
        return std::ranges::any_of(theirs, [&](const std::string& other) { return partition_matches(one, other); });
    });
}

// Each living instance of a built-in topic.
template <class Sample, class Function>
void for_each_alive(dds_entity_t reader, const Function& visit)
{
    constexpr std::size_t most = 1024;
    constexpr std::uint32_t alive = DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos;
    const dds_return_t count = dds_read_mask(reader, samples.data(), infos.data(), samples.size(),
                                             static_cast<std::uint32_t>(samples.size()), alive);
    for (dds_return_t i = 0; i < count; ++i)
        if (infos[static_cast<std::size_t>(i)].valid_data)
            visit(*static_cast<const Sample*>(samples[static_cast<std::size_t>(i)]));
    if (count > 0)
        dds_return_loan(reader, samples.data(), count);
}

}  // namespace

bool partition_matches(const std::string& one, const std::string& other)
{
    if (is_pattern(one) && is_pattern(other))
        return one == other;
    if (is_pattern(one))
        return ::fnmatch(one.c_str(), other.c_str(), 0) == 0;
    return is_pattern(other) ? ::fnmatch(other.c_str(), one.c_str(), 0) == 0 : one == other;
}

struct dds_discovery::state {
    dds_settings settings;
    std::unique_ptr<dds_participant> participant;
    dds_entity_t participants{};
    dds_entity_t writers{};
    dds_entity_t readers{};

    seen_endpoint endpoint(dds_topic which, bool writes, const dds_qos_t* qos) const
    {
        const qos_ptr ours = writes ? reader_qos(settings, which) : writer_qos(settings, which);
        if (writes) {  // what a reader of Cyclone takes that says nothing
            const dds_data_representation_id_t both[] = {DDS_DATA_REPRESENTATION_XCDR1, DDS_DATA_REPRESENTATION_XCDR2};
            dds_qset_data_representation(ours.get(), std::size(both), both);
        }
        seen_endpoint seen{which, writes, partitions_of(qos), {}, {}};
        seen.same_partition = shares_partition(partitions_of(partition_qos(settings).get()), seen.partitions);
        seen.refusals = writes ? incompatible_policies(qos, ours.get()) : incompatible_policies(ours.get(), qos);
        return seen;
    }
};

dds_result<dds_discovery> dds_discovery::create(const dds_settings& settings)
{
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error();
    auto made = std::make_unique<state>();
    made->settings = settings;
    made->participant = std::move(*participant);
    log_capture log;
    const auto create = [&](dds_entity_t topic) {
        return dds_create_reader(made->participant->entity(), topic, nullptr, nullptr);
    };
    made->participants = create(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
    made->writers = create(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
    made->readers = create(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
    for (const dds_entity_t each : {made->participants, made->writers, made->readers})
        if (each < 0)
            return creation_error("reader of DDS discovery", each, log.text());
    return dds_discovery(std::move(made));
}

dds_discovery::dds_discovery(std::unique_ptr<state> s) : state_(std::move(s)) {}
dds_discovery::dds_discovery(dds_discovery&&) noexcept = default;
dds_discovery& dds_discovery::operator=(dds_discovery&&) noexcept = default;
dds_discovery::~dds_discovery() = default;

std::vector<seen_participant> dds_discovery::look()
{
    dds_guid_t self{};
    dds_get_guid(state_->participant->entity(), &self);
    std::map<guid, seen_participant> found;
    for_each_alive<dds_builtintopic_participant_t>(state_->participants, [&](const auto& each) {
        if (guid_of(each.key) == guid_of(self))
            return;
        const std::string pid = property(each.qos, "__Pid");
        const std::string name = property(each.qos, "__ProcessName");
        found[guid_of(each.key)] = {property(each.qos, "__Hostname"),
                                    pid.empty() ? name : fmt::format("{} (process {})", name, pid),
                                    property(each.qos, "__NetworkAddresses"),
                                    {}};
    });
    const auto add = [&](bool writes) {
        return [&, writes](const dds_builtintopic_endpoint_t& each) {
            const auto owner = found.find(guid_of(each.participant_key));
            const auto topic = topic_of(each.topic_name);
            if (owner != found.end() && topic)
                owner->second.endpoints.push_back(state_->endpoint(*topic, writes, each.qos));
        };
    };
    for_each_alive<dds_builtintopic_endpoint_t>(state_->writers, add(true));
    for_each_alive<dds_builtintopic_endpoint_t>(state_->readers, add(false));
    std::vector<seen_participant> all;
    for (auto& [key, each] : found)
        all.push_back(std::move(each));
    return all;
}

}  // namespace plcgw
