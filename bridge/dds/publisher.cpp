#include "bridge/dds/publisher.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/domain.hpp"
#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/quality_code.hpp"
#include "messages.h"
#include "registers.h"

#include <dds/dds.h>

#include <map>
#include <tuple>
#include <unordered_map>

namespace plcgw {
namespace {

static_assert(static_cast<int>(point_kind::none) == plcgw_v1_KIND_NONE);
static_assert(static_cast<int>(point_kind::boolean) == plcgw_v1_KIND_BOOLEAN);
static_assert(static_cast<int>(point_kind::integer) == plcgw_v1_KIND_INTEGER);
static_assert(static_cast<int>(point_kind::real) == plcgw_v1_KIND_REAL);
static_assert(static_cast<int>(point_kind::text) == plcgw_v1_KIND_TEXT);

using instance_key = std::tuple<std::string, std::string, std::uint32_t>;

qos_ptr writer_qos(qos_ptr qos)
{
    // Fast DDS 2.x knows XCDR1 only. Values stay when the gateway ends: it did not dispose of the registers.
    const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
    dds_qset_data_representation(qos.get(), 1, &xcdr1);
    dds_qset_writer_data_lifecycle(qos.get(), false);
    return qos;
}

qos_ptr shared_qos(std::optional<duration> lease)
{
    qos_ptr qos = state_qos();
    if (!lease)
        return qos;
    dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
    dds_qset_ownership_strength(qos.get(), 0);
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_USECS(lease->count()));
    return qos;
}

}  // namespace

struct dds_publisher::state {
    dds_identity who;
    std::unique_ptr<dds_participant> participant;
    dds_entity_t blocks{};    // writer of RegisterBlock
    dds_entity_t points{};    // writer of Point
    dds_entity_t statuses{};  // writer of GatewayStatus
    dds_entity_t messages{};  // writer of SerialMessage
    std::map<instance_key, std::uint64_t, std::less<>> sequence;
    std::map<std::string, std::uint64_t> messages_of;  // each line
    std::unordered_map<std::string, std::uint64_t> points_of;
    std::uint64_t beat = 0;
    std::uint64_t published = 0;
    std::uint64_t drops = 0;
    dds_return_t last_error = DDS_RETCODE_OK;

    plcgw_v1_RegisterBlock keyed(const sample& s) const;
    void count(dds_return_t written);
};

dds_result<dds_publisher> dds_publisher::create(const dds_settings& settings, dds_identity who,
                                                std::optional<duration> shared_lease)
{
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error();

    auto made = std::make_unique<state>();
    made->who = std::move(who);
    made->participant = std::move(*participant);
    const dds_entity_t parent = made->participant->entity();

    log_capture log;
    const dds_entity_t publisher = dds_create_publisher(parent, partition_qos(settings).get(), nullptr);
    if (publisher < 0)
        return creation_error("DDS publisher", publisher, log.text());
    const auto create_writer = [&](const dds_topic_descriptor_t& type, const char* name, qos_ptr qos) {
        const dds_entity_t topic = dds_create_topic(parent, &type, name, nullptr, nullptr);
        return topic < 0 ? topic : dds_create_writer(publisher, topic, writer_qos(std::move(qos)).get(), nullptr);
    };
    // First: who hears the registers does not miss a message from then on.
    made->messages = create_writer(plcgw_v1_SerialMessage_desc, serial_message_topic, event_qos());
    if (made->messages < 0)
        return creation_error("DDS writer of SerialMessage", made->messages, log.text());
    made->blocks = create_writer(plcgw_v1_RegisterBlock_desc, register_block_topic, shared_qos(shared_lease));
    if (made->blocks < 0)
        return creation_error("DDS writer of RegisterBlock", made->blocks, log.text());
    made->points = create_writer(plcgw_v1_Point_desc, point_topic, shared_qos(shared_lease));
    if (made->points < 0)
        return creation_error("DDS writer of Point", made->points, log.text());
    made->statuses = create_writer(plcgw_v1_GatewayStatus_desc, gateway_status_topic, state_qos());
    if (made->statuses < 0)
        return creation_error("DDS writer of GatewayStatus", made->statuses, log.text());
    return dds_publisher(std::move(made));
}

dds_publisher::dds_publisher(std::unique_ptr<state> s) : state_(std::move(s)) {}
dds_publisher::dds_publisher(dds_publisher&&) noexcept = default;
dds_publisher& dds_publisher::operator=(dds_publisher&&) noexcept = default;
dds_publisher::~dds_publisher() = default;

plcgw_v1_RegisterBlock dds_publisher::state::keyed(const sample& s) const
{
    plcgw_v1_RegisterBlock block{};
    fill_string(block.gateway, who.gateway);
    fill_string(block.route, s.route);
    fill_string(block.area, s.area);
    block.first = s.first;
    return block;
}

void dds_publisher::state::count(dds_return_t written)
{
    if (written == DDS_RETCODE_OK) {
        ++published;
        return;
    }
    ++drops;
    last_error = written;
}

void dds_publisher::assert_liveliness()
{
    for (const dds_entity_t writer : {state_->blocks, state_->points})
        dds_assert_liveliness(writer);
}

void dds_publisher::set_strength(std::int32_t strength)
{
    for (const dds_entity_t writer : {state_->blocks, state_->points}) {
        const qos_ptr qos(dds_create_qos());
        dds_qset_ownership_strength(qos.get(), strength);
        const dds_return_t set = dds_set_qos(writer, qos.get());
        if (set != DDS_RETCODE_OK)
            state_->last_error = set;
    }
}

void dds_publisher::publish(const sample& s)
{
    auto instance = state_->sequence.find(std::tie(s.route, s.area, s.first));
    if (instance == state_->sequence.end())
        instance = state_->sequence.emplace(instance_key(s.route, s.area, s.first), 0).first;

    plcgw_v1_RegisterBlock block = state_->keyed(s);
    fill_string(block.member, state_->who.member);
    block.seq = ++instance->second;
    block.source_ns = static_cast<std::int64_t>(s.source);
    block.quality = quality_code(s.state);
    block.format = s.format == sample_format::bits ? plcgw_v1_FORMAT_BITS : plcgw_v1_FORMAT_WORDS;
    block.count = s.count;
    block.words._length = block.words._maximum = static_cast<std::uint32_t>(s.words.size());
    block.words._buffer = const_cast<std::uint16_t*>(s.words.data());  // dds_write only reads it
    state_->count(dds_write(state_->blocks, &block));
}

void dds_publisher::publish(const point_sample& point)
{
    plcgw_v1_Point out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.name, point.name);
    fill_string(out.member, state_->who.member);
    out.seq = ++state_->points_of[std::string(point.name)];
    out.source_ns = static_cast<std::int64_t>(point.source);
    out.quality = quality_code(point.state);
    out.kind = static_cast<std::uint8_t>(point.value.kind);
    out.real = point.value.real;
    out.integer = point.value.integer;
    fill_string(out.text, point.value.text);
    fill_string(out.unit, point.unit);
    state_->count(dds_write(state_->points, &out));
}

void dds_publisher::publish(const gateway_status& status)
{
    plcgw_v1_GatewayStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.member, state_->who.member);
    out.role = static_cast<std::uint8_t>(status.role);
    out.strength = status.strength;
    out.started_ns = static_cast<std::int64_t>(status.started);
    out.beat = ++state_->beat;
    out.routes_up = status.routes_up;
    out.routes_total = status.routes_total;
    fill_string(out.version, state_->who.version);
    fill_string(out.config_hash, state_->who.config_hash);
    state_->count(dds_write(state_->statuses, &out));
}

void dds_publisher::publish(const serial_message& message)
{
    plcgw_v1_SerialMessage out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.member, state_->who.member);
    fill_string(out.line, message.line);
    out.seq = ++state_->messages_of[message.line];
    out.source_ns = static_cast<std::int64_t>(message.when);
    out.way = message.way == message_direction::sent ? plcgw_v1_MESSAGE_SENT : plcgw_v1_MESSAGE_RECEIVED;
    fill_string(out.name, message.name);
    fill_string(out.reason, message.reason);
    out.content._length = out.content._maximum = static_cast<std::uint32_t>(message.content.size());
    out.content._buffer = const_cast<std::uint8_t*>(message.content.data());  // dds_write only reads it
    state_->count(dds_write(state_->messages, &out));
}

void dds_publisher::dispose(const sample& key)
{
    const auto instance = state_->sequence.find(std::tie(key.route, key.area, key.first));
    if (instance == state_->sequence.end())
        return;
    state_->sequence.erase(instance);
    const plcgw_v1_RegisterBlock block = state_->keyed(key);
    dds_return_t written = dds_dispose(state_->blocks, &block);
    if (written == DDS_RETCODE_OK)
        written = dds_unregister_instance(state_->blocks, &block);  // frees most of the instance's memory
    state_->count(written);
}

std::uint64_t dds_publisher::published() const { return state_->published; }
std::uint64_t dds_publisher::drops() const { return state_->drops; }
std::string dds_publisher::last_error() const
{
    return state_->last_error == DDS_RETCODE_OK ? "" : dds_strretcode(state_->last_error);
}

}  // namespace plcgw
