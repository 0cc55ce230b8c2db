#include "bridge/dds/entities.hpp"

#include "bridge/dds/log_capture.hpp"

#include <cerrno>
#include <cstring>
#include <sys/eventfd.h>
#include <unistd.h>

namespace plcgw {
namespace {

// Runs on Cyclone's threads with its locks held: one write and nothing else.
void on_data(dds_entity_t, void* descriptor)
{
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(*static_cast<int*>(descriptor), &one, sizeof one);
}

}  // namespace

dds_entities::dds_entities() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

dds_entities::~dds_entities()
{
    participant_.reset();  // its listeners write to the descriptor
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

std::string dds_entities::open(const dds_settings& settings)
{
    if (descriptor_ < 0)
        return std::string("cannot create an eventfd: ") + std::strerror(errno);
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error().text;
    participant_ = std::move(*participant);
    log_capture log;
    const qos_ptr partition = partition_qos(settings);
    publisher_ = dds_create_publisher(participant_->entity(), partition.get(), nullptr);
    if (publisher_ < 0)
        return creation_error("DDS publisher", publisher_, log.text()).text;
    subscriber_ = dds_create_subscriber(participant_->entity(), partition.get(), nullptr);
    return subscriber_ < 0 ? creation_error("DDS subscriber", subscriber_, log.text()).text : std::string();
}

std::string dds_entities::add_reader(dds_entity_t& made, const dds_topic_descriptor_t& type, const char* topic,
                                     qos_ptr qos)
{
    log_capture log;
    const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listener(dds_create_listener(&descriptor_),
                                                                                   dds_delete_listener);
    dds_lset_data_available(listener.get(), on_data);
    made = dds_create_topic(participant_->entity(), &type, topic, nullptr, nullptr);
    if (made >= 0)
        made = dds_create_reader(subscriber_, made, qos.get(), listener.get());
    return made < 0 ? creation_error(std::string("DDS reader of ") + topic, made, log.text()).text : std::string();
}

std::string dds_entities::add_writer(dds_entity_t& made, const dds_topic_descriptor_t& type, const char* topic,
                                     qos_ptr qos)
{
    log_capture log;
    const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;  // as publisher.cpp
    dds_qset_data_representation(qos.get(), 1, &xcdr1);
    made = dds_create_topic(participant_->entity(), &type, topic, nullptr, nullptr);
    if (made >= 0)
        made = dds_create_writer(publisher_, made, qos.get(), nullptr);
    return made < 0 ? creation_error(std::string("DDS writer of ") + topic, made, log.text()).text : std::string();
}

void dds_entities::read_wakes() const
{
    std::uint64_t wakes = 0;
    [[maybe_unused]] const auto size = ::read(descriptor_, &wakes, sizeof wakes);
}

void dds_entities::wake() const
{
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
}

}  // namespace plcgw
