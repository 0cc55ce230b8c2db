// Internal to bridge/dds: Cyclone's domain and participant. Its entity ids are plain ints, so dds/dds.h stays outside.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/settings.hpp"

#include <cstdint>
#include <memory>

struct dds_qos;
struct dds_topic_descriptor;

namespace plcgw {

using dds_entity_id = std::int32_t;

// Cyclone allows one domain of each id in a process: publisher and subscriber share it, the last one deletes it.
class dds_domain {
public:
    static dds_result<std::shared_ptr<dds_domain>> open(const dds_settings& settings);

    dds_domain(dds_entity_id entity, std::string xml) : entity_(entity), xml_(std::move(xml)) {}
    ~dds_domain();
    dds_domain(const dds_domain&) = delete;
    dds_domain& operator=(const dds_domain&) = delete;

private:
    dds_entity_id entity_;
    std::string xml_;
};

// A participant; deleting it deletes everything in it, and waits for running listeners.
class dds_participant {
public:
    static dds_result<std::unique_ptr<dds_participant>> open(const dds_settings& settings);

    dds_participant(std::shared_ptr<dds_domain> domain, dds_entity_id entity)
        : domain_(std::move(domain)), entity_(entity)
    {
    }
    ~dds_participant();
    dds_participant(const dds_participant&) = delete;
    dds_participant& operator=(const dds_participant&) = delete;

    dds_entity_id entity() const { return entity_; }

private:
    std::shared_ptr<dds_domain> domain_;
    dds_entity_id entity_;
};

struct qos_deleter {
    void operator()(dds_qos* qos) const;
};
using qos_ptr = std::unique_ptr<dds_qos, qos_deleter>;

qos_ptr partition_qos(const dds_settings& settings);  // for a DDS publisher or subscriber
qos_ptr state_qos();  // RELIABLE, TRANSIENT_LOCAL, KEEP_LAST 1: both sides of every state topic
qos_ptr event_qos();  // RELIABLE, VOLATILE, KEEP_LAST 256: writers of events, which a stopped reader must not block

qos_ptr request_qos();  // RELIABLE, VOLATILE, KEEP_ALL, max_samples 256: both sides of requests

const dds_topic_descriptor& type_of(dds_topic which);

// Of the gateway's writers and of our readers of a topic, as the site has set it.
qos_ptr writer_qos(const dds_settings& settings, dds_topic which);
qos_ptr reader_qos(const dds_settings& settings, dds_topic which);

std::string_view policy_name(std::uint32_t policy);  // of dds_..._incompatible_qos_status: "reliability"

inline constexpr auto write_request_topic = "plcgw/v1/WriteRequest";
inline constexpr auto point_write_request_topic = "plcgw/v1/PointWriteRequest";
inline constexpr auto serial_send_request_topic = "plcgw/v1/SerialSendRequest";
inline constexpr auto write_reply_topic = "plcgw/v1/WriteReply";

// "cannot create X: Bad Parameter", and what Cyclone logged about it.
dds_error creation_error(const std::string& what, std::int32_t code, const std::string& logged);

}  // namespace plcgw
