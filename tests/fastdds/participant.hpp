// A Fast DDS participant on loopback, with the QoS that the gateway's topics want (docs/fast-dds.md).
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <string>

namespace fast_dds {

struct settings {
    std::uint32_t domain = 0;
    std::string partition;  // empty: the default one
};

// State topics give a late joiner the last value of each instance, events do not.
enum class topic_kind { state, event };

class participant {
public:
    explicit participant(const settings& where);  // throws std::runtime_error
    participant(const participant&) = delete;
    ~participant();

    // The type is a generated ...PubSubType; the topic is plcgw/v1/ and its name.
    template <class PubSubType>
    eprosima::fastdds::dds::DataReader* reader(const std::string& name, topic_kind kind)
    {
        return make_reader(eprosima::fastdds::dds::TypeSupport(new PubSubType), name, kind);
    }
    template <class PubSubType>
    eprosima::fastdds::dds::DataWriter* writer(const std::string& name)
    {
        return make_writer(eprosima::fastdds::dds::TypeSupport(new PubSubType), name);
    }

private:
    eprosima::fastdds::dds::DomainParticipant* participant_;
    eprosima::fastdds::dds::Publisher* publisher_;
    eprosima::fastdds::dds::Subscriber* subscriber_;

    eprosima::fastdds::dds::Topic* topic(eprosima::fastdds::dds::TypeSupport type, const std::string& name);
    eprosima::fastdds::dds::DataReader* make_reader(eprosima::fastdds::dds::TypeSupport type, const std::string& name,
                                                    topic_kind kind);
    eprosima::fastdds::dds::DataWriter* make_writer(eprosima::fastdds::dds::TypeSupport type, const std::string& name);
};

}  // namespace fast_dds
