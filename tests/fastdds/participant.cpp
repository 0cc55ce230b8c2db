#include "tests/fastdds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <stdexcept>

namespace fast_dds {
namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;

// Loopback has no multicast: each participant of this host is asked for by the port of its index.
DomainParticipantQos loopback()
{
    constexpr int participants = 32;
    const auto udp = std::make_shared<UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->maxInitialPeersRange = participants;
    eprosima::fastrtps::rtps::Locator_t host;
    eprosima::fastrtps::rtps::IPLocator::setIPv4(host, "127.0.0.1");

    DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    qos.wire_protocol().builtin.initialPeersList.push_back(host);
    return qos;
}

template <class Entity>
Entity* made(Entity* entity, const std::string& what)
{
    if (entity == nullptr)
        throw std::runtime_error("cannot create " + what);
    return entity;
}

// By default 10 instances are kept and all others dropped without a word.
void unlimit(ResourceLimitsQosPolicy& limits)
{
    limits.max_samples = LENGTH_UNLIMITED;
    limits.max_instances = LENGTH_UNLIMITED;
    limits.max_samples_per_instance = LENGTH_UNLIMITED;
}

constexpr int kept = 256;  // of each instance: the tests want to see every change

}  // namespace

participant::participant(const settings& where)
    : participant_(
          made(DomainParticipantFactory::get_instance()->create_participant(where.domain, loopback()), "a participant"))
{
    PublisherQos publisher;
    SubscriberQos subscriber;
    if (!where.partition.empty()) {
        publisher.partition().push_back(where.partition.c_str());
        subscriber.partition().push_back(where.partition.c_str());
    }
    publisher_ = made(participant_->create_publisher(publisher), "a publisher");
    subscriber_ = made(participant_->create_subscriber(subscriber), "a subscriber");
}

participant::~participant()
{
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

Topic* participant::topic(TypeSupport type, const std::string& name)
{
    type.register_type(participant_);
    return made(participant_->create_topic("plcgw/v1/" + name, type.get_type_name(), TOPIC_QOS_DEFAULT),
                "topic " + name);
}

DataReader* participant::make_reader(TypeSupport type, const std::string& name, topic_kind kind)
{
    DataReaderQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = kind == topic_kind::state ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = kept;
    unlimit(qos.resource_limits());
    return made(subscriber_->create_datareader(topic(type, name), qos), "a reader of " + name);
}

DataWriter* participant::make_writer(TypeSupport type, const std::string& name)
{
    DataWriterQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = kept;
    unlimit(qos.resource_limits());
    return made(publisher_->create_datawriter(topic(type, name), qos), "a writer of " + name);
}

}  // namespace fast_dds
