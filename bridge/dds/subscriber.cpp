#include "bridge/dds/subscriber.hpp"

#include "bridge/dds/domain.hpp"
#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/received.hpp"

#include <dds/dds.h>

#include <algorithm>
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
    struct reader {
        dds_topic which;
        dds_entity_t entity;
    };

    dds_settings settings;
    int descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::unique_ptr<dds_participant> participant;
    dds_entity_t subscriber{};
    std::vector<reader> readers;
    bool hears_pairs = false;

    ~state()
    {
        participant.reset();  // waits for running listeners, which write to the descriptor
        if (descriptor >= 0)
            ::close(descriptor);
    }

    dds_return_t add_reader(dds_topic which, dds_ownership_kind_t ownership)
    {
        const std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)> listener(dds_create_listener(&descriptor),
                                                                                       dds_delete_listener);
        dds_lset_data_available(listener.get(), on_data);
        const qos_ptr qos = reader_qos(settings, which);
        dds_qset_ownership(qos.get(), ownership);
        dds_entity_t made =
            dds_create_topic(participant->entity(), &type_of(which), topic_name(which), nullptr, nullptr);
        if (made >= 0)
            made = dds_create_reader(subscriber, made, qos.get(), listener.get());
        if (made >= 0)
            readers.push_back({which, made});
        return made;
    }

    // A reader matches only writers of its own kind of ownership. Not before a pair is there: gateways alone would be
    // told of readers that ask for what they do not offer.
    void hear_pairs()
    {
        if (std::exchange(hears_pairs, true))
            return;
        for (std::size_t i = 0; i < dds_topics; ++i)
            if (const auto which = static_cast<dds_topic>(i); is_shared_by_a_pair(which))
                add_reader(which, DDS_OWNERSHIP_EXCLUSIVE);
    }
};

dds_result<dds_subscriber> dds_subscriber::create(const dds_settings& settings)
{
    auto made = std::make_unique<state>();
    made->settings = settings;
    if (made->descriptor < 0)
        return dds_error{std::string("cannot create an eventfd: ") + std::strerror(errno)};
    auto participant = dds_participant::open(settings);
    if (!participant)
        return participant.error();
    made->participant = std::move(*participant);

    log_capture log;
    made->subscriber = dds_create_subscriber(made->participant->entity(), partition_qos(settings).get(), nullptr);
    if (made->subscriber < 0)
        return creation_error("DDS subscriber", made->subscriber, log.text());
    // Events first: who hears the state does not miss one from then on.
    for (std::size_t i = 0; i < dds_topics; ++i) {
        const auto which = static_cast<dds_topic>(i);
        if (const dds_return_t failed = made->add_reader(which, DDS_OWNERSHIP_SHARED); failed < 0)
            return creation_error("DDS reader of " + std::string(to_string(which)), failed, log.text());
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
    const bool is_pair = std::any_of(events.begin(), events.end(), [](const dds_event& each) {
        const auto* const heard = std::get_if<received_status>(&each);
        return heard != nullptr && heard->status.role != gateway_role::solo;
    });
    if (is_pair)
        state_->hear_pairs();
    if (more)
        wake(state_->descriptor);
    return events;
}

}  // namespace plcgw
