#include "bridge/dds/publisher.hpp"

#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/publisher_state.hpp"

#include <fmt/format.h>

namespace plcgw {
namespace {

// Members of a pair write the same instances: subscribers hear the stronger one, while it asserts that it lives.
qos_ptr shared_qos(qos_ptr qos, duration lease)
{
    dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
    dds_qset_ownership_strength(qos.get(), 0);
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_USECS(lease.count()));
    return qos;
}

}  // namespace

dds_result<dds_publisher> dds_publisher::create(const dds_settings& settings, dds_identity who,
                                                std::optional<duration> shared_lease)
{
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error();

    auto made = std::make_unique<state>();
    made->settings = settings;
    made->who = std::move(who);
    made->participant = std::move(*participant);
    const dds_entity_t parent = made->participant->entity();

    log_capture log;
    const dds_entity_t publisher = dds_create_publisher(parent, partition_qos(settings).get(), nullptr);
    if (publisher < 0)
        return creation_error("DDS publisher", publisher, log.text());
    // Events first: who hears the state does not miss one from then on.
    for (std::size_t i = 0; i < dds_topics; ++i) {
        const auto which = static_cast<dds_topic>(i);
        if (!settings.topic(which).enabled)
            continue;
        dds_entity_t made_now = dds_create_topic(parent, &type_of(which), topic_name(which), nullptr, nullptr);
        qos_ptr qos = writer_qos(settings, which);
        if (shared_lease && is_shared_by_a_pair(which))
            qos = shared_qos(std::move(qos), *shared_lease);
        if (made_now >= 0)
            made_now = dds_create_writer(publisher, made_now, qos.get(), nullptr);
        if (made_now < 0)
            return creation_error(fmt::format("DDS writer of {}", to_string(which)), made_now, log.text());
        made->writers[i] = made_now;
    }
    return dds_publisher(std::move(made));
}

dds_publisher::dds_publisher(std::unique_ptr<state> s) : state_(std::move(s)) {}
dds_publisher::dds_publisher(dds_publisher&&) noexcept = default;
dds_publisher& dds_publisher::operator=(dds_publisher&&) noexcept = default;
dds_publisher::~dds_publisher() = default;

void dds_publisher::assert_liveliness()
{
    for (std::size_t i = 0; i < dds_topics; ++i)
        if (state_->writers[i] != 0 && is_shared_by_a_pair(static_cast<dds_topic>(i)))
            dds_assert_liveliness(state_->writers[i]);
}

void dds_publisher::set_strength(std::int32_t strength)
{
    for (std::size_t i = 0; i < dds_topics; ++i) {
        if (state_->writers[i] == 0 || !is_shared_by_a_pair(static_cast<dds_topic>(i)))
            continue;
        const qos_ptr qos(dds_create_qos());
        dds_qset_ownership_strength(qos.get(), strength);
        const dds_return_t set = dds_set_qos(state_->writers[i], qos.get());
        if (set != DDS_RETCODE_OK)
            state_->last_error = set;
    }
}

std::vector<std::string> dds_publisher::take_refusals()
{
    std::vector<std::string> news;
    for (std::size_t i = 0; i < dds_topics; ++i) {
        dds_offered_incompatible_qos_status_t status{};
        if (state_->writers[i] == 0 || dds_get_offered_incompatible_qos_status(state_->writers[i], &status) != 0 ||
            status.total_count == state_->refused[i])
            continue;
        state_->refused[i] = status.total_count;
        if (status.last_policy_id == DDS_OWNERSHIP_QOS_POLICY_ID)
            continue;  // subscribers that hear pairs and gateways alone have readers of both kinds
        news.push_back(fmt::format("a reader of {} asks for another {}", topic_name(static_cast<dds_topic>(i)),
                                   policy_name(status.last_policy_id)));
    }
    return news;
}

std::uint64_t dds_publisher::published() const { return state_->published; }
std::uint64_t dds_publisher::drops() const { return state_->drops; }
std::string dds_publisher::last_error() const
{
    return state_->last_error == DDS_RETCODE_OK ? "" : dds_strretcode(state_->last_error);
}

}  // namespace plcgw
