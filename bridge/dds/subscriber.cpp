#include "bridge/dds/subscriber.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/domain.hpp"
#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/quality_code.hpp"
#include "messages.h"
#include "registers.h"

#include <dds/dds.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sys/eventfd.h>
#include <type_traits>
#include <unistd.h>

namespace plcgw {
namespace {

// Runs on Cyclone's threads with its locks held, and wake-ups coalesce in the counter: one write and nothing else.
void wake(int descriptor)
{
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(descriptor, &one, sizeof one);
}

// More than a writer keeps: what came while we were drawing is still there.
qos_ptr message_reader_qos()
{
    constexpr std::int32_t kept = 8192;
    qos_ptr qos = event_qos();
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept);
    return qos;
}

void on_data(dds_entity_t, void* descriptor) { wake(*static_cast<int*>(descriptor)); }

std::string text(std::span<const char> in) { return std::string(read_string(in)); }

dds_event received(const plcgw_v1_RegisterBlock& in)
{
    received_block out{text(in.gateway), text(in.member), in.seq, in.quality, {}};
    out.value.route = text(in.route);
    out.value.area = text(in.area);
    out.value.first = in.first;
    out.value.format = in.format == plcgw_v1_FORMAT_BITS ? sample_format::bits : sample_format::words;
    out.value.count = in.count;
    out.value.words.assign(in.words._buffer, in.words._buffer + in.words._length);
    out.value.state = quality_from_code(in.quality);
    out.value.source = wall_time{in.source_ns};
    return out;
}

dds_event received(const plcgw_v1_Point& in)
{
    received_point out{text(in.gateway), text(in.member), in.seq, in.quality, text(in.name), {}, {}, {}, {}};
    const bool known = in.kind <= plcgw_v1_KIND_TEXT;
    out.value = {known ? point_kind{in.kind} : point_kind::none, in.real, in.integer, text(in.text)};
    out.state = quality_from_code(in.quality);
    out.source = wall_time{in.source_ns};
    out.unit = text(in.unit);
    return out;
}

dds_event received(const plcgw_v1_GatewayStatus& in)
{
    received_status out;
    out.who = {text(in.gateway), text(in.member), text(in.version), text(in.config_hash)};
    out.status.role = gateway_role{in.role};
    out.status.strength = in.strength;
    out.status.started = wall_time{in.started_ns};
    out.status.routes_up = in.routes_up;
    out.status.routes_total = in.routes_total;
    out.beat = in.beat;
    return out;
}

dds_event received(const plcgw_v1_SerialMessage& in)
{
    received_message out{text(in.gateway), text(in.member), in.seq, {}};
    out.value.line = text(in.line);
    out.value.way = in.way == plcgw_v1_MESSAGE_SENT ? message_direction::sent : message_direction::received;
    out.value.name = text(in.name);
    out.value.reason = text(in.reason);
    out.value.content.assign(in.content._buffer, in.content._buffer + in.content._length);
    out.value.when = wall_time{in.source_ns};
    return out;
}

dds_event gone(const plcgw_v1_RegisterBlock& key, gone_reason reason)
{
    return gone_block{text(key.gateway), text(key.route), text(key.area), key.first, reason};
}

dds_event gone(const plcgw_v1_Point& key, gone_reason reason)
{
    return gone_point{text(key.gateway), text(key.name), reason};
}

dds_event gone(const plcgw_v1_GatewayStatus& key, gone_reason reason)
{
    return gone_gateway{text(key.gateway), text(key.member), reason};
}

// An event has no instance that could go away.
template <class Topic>
constexpr bool is_state = !std::is_same_v<Topic, plcgw_v1_SerialMessage>;

// One loan of Cyclone; false when the reader is empty.
template <class Topic>
bool take_some(dds_entity_t reader, std::vector<dds_event>& events)
{
    constexpr std::size_t most = 64;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos;
    const dds_return_t taken = dds_take(reader, samples.data(), infos.data(), most, most);
    if (taken <= 0)
        return false;

    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
        const auto& in = *static_cast<const Topic*>(samples[i]);
        const auto& info = infos[i];
        if (info.valid_data)
            events.push_back(received(in));
        // The last value and the end of its writer can come as one sample.
        if constexpr (is_state<Topic>) {
            if (info.instance_state != DDS_ALIVE_INSTANCE_STATE && info.sample_rank == 0)
                events.push_back(gone(in, info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE
                                              ? gone_reason::disposed
                                              : gone_reason::writer_lost));
        }
    }
    dds_return_loan(reader, samples.data(), taken);
    return true;
}

}  // namespace

struct dds_subscriber::state {
    int descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::unique_ptr<dds_participant> participant;
    // Of gateways alone and of pairs: a reader matches only writers of its own kind of ownership.
    std::array<dds_entity_t, 2> blocks{};  // readers of RegisterBlock
    std::array<dds_entity_t, 2> points{};  // readers of Point
    dds_entity_t statuses{};               // reader of GatewayStatus
    dds_entity_t messages{};               // reader of SerialMessage

    ~state()
    {
        participant.reset();  // waits for running listeners, which write to the descriptor
        if (descriptor >= 0)
            ::close(descriptor);
    }
};

dds_result<dds_subscriber> dds_subscriber::create(const dds_settings& settings)
{
    auto made = std::make_unique<state>();
    if (made->descriptor < 0)
        return dds_error{std::string("cannot create an eventfd: ") + std::strerror(errno)};
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error();
    made->participant = std::move(*participant);
    const dds_entity_t parent = made->participant->entity();

    log_capture log;
    const dds_entity_t subscriber = dds_create_subscriber(parent, partition_qos(settings).get(), nullptr);
    if (subscriber < 0)
        return creation_error("DDS subscriber", subscriber, log.text());
    const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listener(
        dds_create_listener(&made->descriptor), dds_delete_listener);
    dds_lset_data_available(listener.get(), on_data);
    const auto create_reader = [&](const dds_topic_descriptor_t& type, const char* name, const qos_ptr& qos) {
        const dds_entity_t topic = dds_create_topic(parent, &type, name, nullptr, nullptr);
        return topic < 0 ? topic : dds_create_reader(subscriber, topic, qos.get(), listener.get());
    };
    // First: who hears the registers does not miss a message from then on.
    made->messages = create_reader(plcgw_v1_SerialMessage_desc, serial_message_topic, message_reader_qos());
    if (made->messages < 0)
        return creation_error("DDS reader of SerialMessage", made->messages, log.text());
    for (std::size_t i = 0; i < made->blocks.size(); ++i) {
        qos_ptr qos = state_qos();
        dds_qset_ownership(qos.get(), i == 0 ? DDS_OWNERSHIP_SHARED : DDS_OWNERSHIP_EXCLUSIVE);
        made->blocks[i] = create_reader(plcgw_v1_RegisterBlock_desc, register_block_topic, qos);
        if (made->blocks[i] < 0)
            return creation_error("DDS reader of RegisterBlock", made->blocks[i], log.text());
        made->points[i] = create_reader(plcgw_v1_Point_desc, point_topic, qos);
        if (made->points[i] < 0)
            return creation_error("DDS reader of Point", made->points[i], log.text());
    }
    made->statuses = create_reader(plcgw_v1_GatewayStatus_desc, gateway_status_topic, state_qos());
    if (made->statuses < 0)
        return creation_error("DDS reader of GatewayStatus", made->statuses, log.text());
    return dds_subscriber(std::move(made));
}

dds_subscriber::dds_subscriber(std::unique_ptr<state> s) : state_(std::move(s)) {}
dds_subscriber::dds_subscriber(dds_subscriber&&) noexcept = default;
dds_subscriber& dds_subscriber::operator=(dds_subscriber&&) noexcept = default;
dds_subscriber::~dds_subscriber() = default;

int dds_subscriber::descriptor() const { return state_->descriptor; }

std::vector<dds_event> dds_subscriber::take(std::size_t most)
{
    std::uint64_t wakes = 0;
    [[maybe_unused]] const auto size = ::read(state_->descriptor, &wakes, sizeof wakes);

    std::vector<dds_event> events;
    bool more = true;
    while (more && events.size() < most) {
        const bool statuses = take_some<plcgw_v1_GatewayStatus>(state_->statuses, events);
        const bool messages = take_some<plcgw_v1_SerialMessage>(state_->messages, events);
        more = statuses || messages;
        for (std::size_t i = 0; i < state_->blocks.size(); ++i) {
            more = take_some<plcgw_v1_Point>(state_->points[i], events) || more;
            more = take_some<plcgw_v1_RegisterBlock>(state_->blocks[i], events) || more;
        }
    }
    if (more)
        wake(state_->descriptor);
    return events;
}

}  // namespace plcgw
