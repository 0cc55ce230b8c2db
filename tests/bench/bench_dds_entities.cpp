#include "tests/bench/bench_dds_entities.hpp"

#include <ctime>
#include <stdexcept>

namespace plcgw::bench {
namespace {

dds_entity_t made(dds_entity_t entity, const char* what)
{
    if (entity < 0)
        throw std::runtime_error(std::string("cannot create a ") + what + ": " + dds_strretcode(entity));
    return entity;
}

std::unique_ptr<dds_participant> open(const dds_settings& settings)
{
    auto participant = dds_participant::open(settings);
    if (!participant)
        throw std::runtime_error(participant.error().text);
    return std::move(*participant);
}

}  // namespace

std::int64_t monotonic_ns()
{
    constexpr std::int64_t second = 1'000'000'000;
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * second + time.tv_nsec;
}

dds_parts::dds_parts(const dds_settings& settings)
    : participant_(open(settings)),
      publisher_(
          made(dds_create_publisher(participant_->entity(), partition_qos(settings).get(), nullptr), "publisher")),
      subscriber_(
          made(dds_create_subscriber(participant_->entity(), partition_qos(settings).get(), nullptr), "subscriber"))
{
}

dds_entity_t dds_parts::make_writer(const dds_topic_descriptor_t& type, const char* topic)
{
    const qos_ptr qos = state_qos();
    const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &xcdr1);
    dds_qset_writer_data_lifecycle(qos.get(), false);
    const dds_entity_t of = made(dds_create_topic(participant_->entity(), &type, topic, nullptr, nullptr), "topic");
    return made(dds_create_writer(publisher_, of, qos.get(), nullptr), "writer");
}

dds_entity_t dds_parts::make_reader(const dds_topic_descriptor_t& type, const char* topic,
                                    const dds_listener_t* listener)
{
    const dds_entity_t of = made(dds_create_topic(participant_->entity(), &type, topic, nullptr, nullptr), "topic");
    return made(dds_create_reader(subscriber_, of, state_qos().get(), listener), "reader");
}

}  // namespace plcgw::bench
