#include "bridge/dds/plc_link_port.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/entities.hpp"
#include "plc_link.h"

#include <array>

namespace plcgw {
namespace {

constexpr auto link_topic = "plcgw/v1/PlcLinkArea";
constexpr std::size_t most_news = 1000;  // a writer of made-up names must not keep the loop busy

qos_ptr writer_qos(duration lease)
{
    qos_ptr qos = state_qos();
    dds_qset_writer_data_lifecycle(qos.get(), false);
    // By topic: each writing asserts it, and a gateway that hangs does not write.
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_USECS(lease.count()));
    return qos;
}

std::string text(std::span<const char> in) { return std::string(read_string(in)); }

template <class Sequence>
void lend(Sequence& to, const std::vector<std::uint16_t>& words)
{
    to._length = to._maximum = static_cast<std::uint32_t>(words.size());
    to._buffer = const_cast<std::uint16_t*>(words.data());  // dds_write only reads it
}

template <class Sequence>
std::vector<std::uint16_t> copy(const Sequence& from)
{
    return std::vector<std::uint16_t>(from._buffer, from._buffer + from._length);
}

plc_link_area received(const plcgw_v1_PlcLinkArea& in)
{
    plc_link_area out;
    out.link = text(in.link);
    out.sender = {text(in.gateway), text(in.member), wall_time{in.started_ns}};
    out.sequence = in.seq;
    out.source = wall_time{in.source_ns};
    out.relays = copy(in.relays);
    out.registers = copy(in.registers);
    out.station.station = in.station;
    out.station.settings = {.block = in.block,
                            .max_station = in.max_station,
                            .relay_words = in.relay_words,
                            .register_words = in.register_words,
                            .relay_first = in.relay_first,
                            .relay_count = in.relays._length,
                            .register_first = in.register_first,
                            .register_count = in.registers._length};
    return out;
}

// One loan of Cyclone; false when the reader is empty.
bool take_some(dds_entity_t reader, std::vector<plc_link_news>& news)
{
    constexpr std::size_t most = 64;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos;
    const dds_return_t taken = dds_take(reader, samples.data(), infos.data(), most, most);
    if (taken <= 0)
        return false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
        const auto& in = *static_cast<const plcgw_v1_PlcLinkArea*>(samples[i]);
        if (infos[i].valid_data)
            news.push_back(received(in));
        // The last words and the end of their writer can come as one sample.
        if (infos[i].instance_state != DDS_ALIVE_INSTANCE_STATE && infos[i].sample_rank == 0)
            news.push_back(plc_link_gone{text(in.link), text(in.gateway), text(in.member), in.station});
    }
    dds_return_loan(reader, samples.data(), taken);
    return true;
}

}  // namespace

struct plc_link_port::state {
    dds_entities entities;
    dds_entity_t writer{};
    dds_entity_t reader{};
    std::uint64_t drops = 0;
};

dds_result<plc_link_port> plc_link_port::create(const dds_settings& settings, duration lease)
{
    auto made = std::make_unique<state>();
    std::string failed = made->entities.open(settings);
    if (failed.empty())
        failed = made->entities.add_reader(made->reader, plcgw_v1_PlcLinkArea_desc, link_topic, state_qos());
    if (failed.empty())
        failed = made->entities.add_writer(made->writer, plcgw_v1_PlcLinkArea_desc, link_topic, writer_qos(lease));
    if (!failed.empty())
        return dds_error{failed};
    return plc_link_port(std::move(made));
}

plc_link_port::plc_link_port(std::unique_ptr<state> s) : state_(std::move(s)) {}
plc_link_port::plc_link_port(plc_link_port&&) noexcept = default;
plc_link_port& plc_link_port::operator=(plc_link_port&&) noexcept = default;
plc_link_port::~plc_link_port() = default;

void plc_link_port::publish(const plc_link_area& area)
{
    const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value); };
    const plc_link_settings& s = area.station.settings;
    plcgw_v1_PlcLinkArea out{};
    fill_string(out.link, area.link);
    fill_string(out.gateway, area.sender.gateway);
    fill_string(out.member, area.sender.member);
    out.station = byte(area.station.station);
    out.started_ns = static_cast<std::int64_t>(area.sender.started);
    out.seq = area.sequence;
    out.source_ns = static_cast<std::int64_t>(area.source);
    out.block = byte(s.block);
    out.max_station = byte(s.max_station);
    out.relay_words = byte(s.relay_words);
    out.register_words = byte(s.register_words);
    out.relay_first = byte(s.relay_first);
    out.register_first = byte(s.register_first);
    lend(out.relays, area.relays);
    lend(out.registers, area.registers);
    if (dds_write(state_->writer, &out) != DDS_RETCODE_OK)
        ++state_->drops;
}

std::uint64_t plc_link_port::drops() const { return state_->drops; }

int plc_link_port::descriptor() const { return state_->entities.descriptor(); }

std::vector<plc_link_news> plc_link_port::take()
{
    state_->entities.read_wakes();
    std::vector<plc_link_news> news;
    while (news.size() < most_news)
        if (!take_some(state_->reader, news))
            return news;
    state_->entities.wake();
    return news;
}

}  // namespace plcgw
