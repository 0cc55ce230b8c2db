// What a site sets of the DDS topics.
#pragma once

#include "bridge/dds/topics.hpp"

namespace plcgw {

// Of a state topic, of which the last sample is kept, and of one whose samples are events.
struct state_topic_config : topic_settings {};
struct event_topic_config : topic_settings {};

struct topics_config {
    state_topic_config register_block;
    state_topic_config point;
    state_topic_config port_status;
    state_topic_config device_status;
    state_topic_config gateway_status;
    event_topic_config event;
    event_topic_config serial_message;

    std::array<topic_settings, dds_topics> all() const  // in the order of dds_topic
    {
        return {serial_message, event, register_block, point, port_status, device_status, gateway_status};
    }
};

}  // namespace plcgw
