// A participant with the gateway's settings, and writers and readers with the QoS of its state topics.
#pragma once

#include "bridge/dds/domain.hpp"

#include <dds/dds.h>

#include <cstdint>
#include <memory>

namespace plcgw::bench {

std::int64_t monotonic_ns();

class dds_parts {
public:
    explicit dds_parts(const dds_settings& settings);  // throws std::runtime_error, as the others

    dds_entity_t make_writer(const dds_topic_descriptor_t& type, const char* topic);
    dds_entity_t make_reader(const dds_topic_descriptor_t& type, const char* topic, const dds_listener_t* listener);
    void close() { participant_.reset(); }

private:
    std::unique_ptr<dds_participant> participant_;
    dds_entity_t publisher_;
    dds_entity_t subscriber_;
};

}  // namespace plcgw::bench
