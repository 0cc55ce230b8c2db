#include "bridge/dds/subscriber.hpp"

#include "bridge/dds/domain.hpp"
#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/received.hpp"

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

void on_data(dds_entity_t, void* descriptor) { wake(*static_cast<int*>(descriptor)); }

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
        if constexpr (requires { gone(in, gone_reason{}); }) {
            if (info.instance_state != DDS_ALIVE_INSTANCE_STATE && info.sample_rank == 0)
                events.push_back(gone(in, info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE
                                              ? gone_reason::disposed
                                              : gone_reason::writer_lost));
        }
    }
    dds_return_loan(reader, samples.data(), taken);
    return true;
}

bool take_some(dds_topic which, dds_entity_t reader, std::vector<dds_event>& events)
{
    switch (which) {
    case dds_topic::serial_message: return take_some<plcgw_v1_SerialMessage>(reader, events);
    case dds_topic::event: return take_some<plcgw_v1_Event>(reader, events);
    case dds_topic::register_block: return take_some<plcgw_v1_RegisterBlock>(reader, events);
    case dds_topic::point: return take_some<plcgw_v1_Point>(reader, events);
    case dds_topic::port_status: return take_some<plcgw_v1_PortStatus>(reader, events);
    case dds_topic::device_status: return take_some<plcgw_v1_DeviceStatus>(reader, events);
    case dds_topic::gateway_status: return take_some<plcgw_v1_GatewayStatus>(reader, events);
    }
    return false;
}

}  // namespace

struct dds_subscriber::state {
    int descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::unique_ptr<dds_participant> participant;
    struct reader {
        dds_topic which;
        dds_entity_t entity;
    };
    // Of gateways alone and of pairs: a reader matches only writers of its own kind of ownership.
    std::vector<reader> readers;

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
    const auto create_reader = [&](dds_topic which, const qos_ptr& qos) {
        const dds_entity_t topic = dds_create_topic(parent, &type_of(which), topic_name(which), nullptr, nullptr);
        const dds_entity_t made_now =
            topic < 0 ? topic : dds_create_reader(subscriber, topic, qos.get(), listener.get());
        made->readers.push_back({which, made_now});
        return made_now;
    };
    // Events first: who hears the state does not miss one from then on.
    for (std::size_t i = 0; i < dds_topics; ++i) {
        const auto which = static_cast<dds_topic>(i);
        const qos_ptr qos = reader_qos(settings, which);
        dds_entity_t made_now = create_reader(which, qos);
        if (made_now >= 0 && is_shared_by_a_pair(which)) {
            dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
            made_now = create_reader(which, qos);
        }
        if (made_now < 0)
            return creation_error("DDS reader of " + std::string(to_string(which)), made_now, log.text());
    }
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
        more = false;
        for (const auto& each : state_->readers)
            more = take_some(each.which, each.entity, events) || more;
    }
    if (more)
        wake(state_->descriptor);
    return events;
}

}  // namespace plcgw
