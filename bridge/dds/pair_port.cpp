#include "bridge/dds/pair_port.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/entities.hpp"
#include "bridge/dds/quality_code.hpp"
#include "pair.h"

#include <algorithm>
#include <array>
#include <optional>

namespace plcgw {
namespace {

static_assert(static_cast<int>(pair_role::starting) == plcgw_v1_PAIR_STARTING);
static_assert(static_cast<int>(pair_role::standby) == plcgw_v1_PAIR_STANDBY);
static_assert(static_cast<int>(pair_role::active) == plcgw_v1_PAIR_ACTIVE);
static_assert(static_cast<int>(line_report::unknown) == plcgw_v1_PAIR_LINE_UNKNOWN);
static_assert(static_cast<int>(line_report::closed) == plcgw_v1_PAIR_LINE_CLOSED);
static_assert(static_cast<int>(line_report::mute) == plcgw_v1_PAIR_LINE_MUTE);
static_assert(static_cast<int>(line_report::good) == plcgw_v1_PAIR_LINE_GOOD);

constexpr std::size_t most_news = 1000;  // a large memory must not keep the loop busy
constexpr std::size_t most_lines = 64;

qos_ptr writer_qos(std::optional<duration> lease)
{
    qos_ptr qos = state_qos();
    dds_qset_writer_data_lifecycle(qos.get(), false);
    // By topic: each writing asserts it, and a gateway that hangs does not write.
    if (lease)
        dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_USECS(lease->count()));
    return qos;
}

std::string text(std::span<const char> in) { return std::string(read_string(in)); }

template <class Sequence>
void lend(Sequence& to, const std::vector<std::uint16_t>& words)
{
    to._length = to._maximum = static_cast<std::uint32_t>(words.size());
    to._buffer = const_cast<std::uint16_t*>(words.data());  // dds_write only reads it
}

pair_news received(const plcgw_v1_PairBeat& in)
{
    pair_beat out;
    out.member = text(in.member);
    out.role = in.role <= plcgw_v1_PAIR_ACTIVE ? pair_role{in.role} : pair_role::starting;
    out.term = in.term;
    out.priority = in.priority;
    out.claims = (in.flags & plcgw_v1_PAIR_CLAIMS) != 0;
    out.offers = (in.flags & plcgw_v1_PAIR_OFFERS) != 0;
    out.leaves = (in.flags & plcgw_v1_PAIR_LEAVES) != 0;
    out.keeps = (in.flags & plcgw_v1_PAIR_KEEPS) != 0;
    for (std::uint32_t i = 0; i < in.lines._length; ++i) {
        const plcgw_v1_PairLine& each = in.lines._buffer[i];
        const bool known = each.state <= plcgw_v1_PAIR_LINE_GOOD;
        pair_line_report& line = out.lines.emplace_back();
        line.line = text(each.line);
        line.state = known ? line_report{each.state} : line_report::unknown;
        line.speaks = each.speaks;
        if (each.asked_us >= 0)
            line.asked = duration(each.asked_us);
    }
    return out;
}

pair_news received(const plcgw_v1_PairMemory& in)
{
    return memory_chunk{text(in.plc), in.area, in.first, in.term,
                        std::vector<std::uint16_t>(in.words._buffer, in.words._buffer + in.words._length)};
}

pair_news received(const plcgw_v1_PairRoute& in)
{
    return route_record{text(in.route),
                        in.writes,
                        in.term,
                        quality_from_code(in.quality),
                        wall_time{in.source_ns},
                        in.reason_code,
                        in.answers,
                        in.errors,
                        text(in.reason),
                        std::vector<std::uint16_t>(in.words._buffer, in.words._buffer + in.words._length)};
}

}  // namespace

struct pair_port::state {
    pair_identity who;
    dds_entities entities;
    dds_entity_t beat_writer{};
    dds_entity_t beat_reader{};
    dds_entity_t memory_writer{};
    dds_entity_t memory_reader{};
    dds_entity_t route_writer{};
    dds_entity_t route_reader{};
    std::uint64_t sequence = 0;
    std::uint64_t drops = 0;

    void count(dds_return_t written) { drops += written == DDS_RETCODE_OK ? 0 : 1; }

    template <class Topic>
    Topic keyed()
    {
        Topic out{};
        fill_string(out.gateway, who.gateway);
        fill_string(out.member, who.member);
        out.seq = ++sequence;
        return out;
    }

    template <class Topic>
    bool is_of_the_other(const Topic& in) const
    {
        return read_string(in.gateway) == who.gateway && read_string(in.member) != who.member;
    }

    bool is_namesake(const plcgw_v1_PairBeat& in) const
    {
        return read_string(in.gateway) == who.gateway && read_string(in.member) == who.member &&
               in.started_ns != static_cast<std::int64_t>(who.started);
    }

    pair_news of_namesake(const plcgw_v1_PairBeat& in) const
    {
        pair_news made = received(in);
        const bool is_later = in.started_ns > static_cast<std::int64_t>(who.started);
        std::get<pair_beat>(made).member = is_later ? "" : who.member + "'";
        return made;
    }

    // One loan of Cyclone; false when the reader is empty.
    template <class Topic>
    bool take_some(dds_entity_t reader, std::vector<pair_news>& news)
    {
        constexpr std::size_t most = 64;
        std::array<void*, most> samples{};
        std::array<dds_sample_info_t, most> infos;
        const dds_return_t taken = dds_take(reader, samples.data(), infos.data(), most, most);
        if (taken <= 0)
            return false;
        for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
            const auto& in = *static_cast<const Topic*>(samples[i]);
            if constexpr (std::is_same_v<Topic, plcgw_v1_PairBeat>)
                if (infos[i].valid_data && is_namesake(in))
                    news.push_back(of_namesake(in));
            if (!is_of_the_other(in))
                continue;
            if (infos[i].valid_data)
                news.push_back(received(in));
            if constexpr (std::is_same_v<Topic, plcgw_v1_PairBeat>)
                // The last words and the end of their writer can come as one sample.
                if (infos[i].instance_state != DDS_ALIVE_INSTANCE_STATE && infos[i].sample_rank == 0)
                    news.push_back(pair_lost{text(in.member)});
        }
        dds_return_loan(reader, samples.data(), taken);
        return true;
    }
};

dds_result<pair_port> pair_port::create(const dds_settings& settings, pair_identity who, duration lease)
{
    auto made = std::make_unique<state>();
    made->who = std::move(who);
    dds_entities& entities = made->entities;
    std::string failed = entities.open(settings);
    const auto open = [&](const dds_topic_descriptor_t& type, const char* name, std::optional<duration> alive,
                          dds_entity_t& reader, dds_entity_t& writer) {
        if (failed.empty())
            failed = entities.add_reader(reader, type, name, state_qos());
        if (failed.empty())
            failed = entities.add_writer(writer, type, name, writer_qos(alive));
    };
    open(plcgw_v1_PairMemory_desc, "plcgw/v1/PairMemory", {}, made->memory_reader, made->memory_writer);
    open(plcgw_v1_PairRoute_desc, "plcgw/v1/PairRoute", {}, made->route_reader, made->route_writer);
    open(plcgw_v1_PairBeat_desc, "plcgw/v1/PairBeat", lease, made->beat_reader, made->beat_writer);
    if (!failed.empty())
        return dds_error{failed};
    return pair_port(std::move(made));
}

pair_port::pair_port(std::unique_ptr<state> s) : state_(std::move(s)) {}
pair_port::pair_port(pair_port&&) noexcept = default;
pair_port& pair_port::operator=(pair_port&&) noexcept = default;
pair_port::~pair_port() = default;

void pair_port::publish(const pair_beat& beat)
{
    std::array<plcgw_v1_PairLine, most_lines> lines{};
    const std::size_t count = std::min(beat.lines.size(), most_lines);
    for (std::size_t i = 0; i < count; ++i) {
        fill_string(lines[i].line, beat.lines[i].line);
        lines[i].state = static_cast<std::uint8_t>(beat.lines[i].state);
        lines[i].speaks = beat.lines[i].speaks;
        lines[i].asked_us = beat.lines[i].asked.value_or(duration(-1)).count();
    }
    const auto flag = [](bool on, unsigned bit) { return on ? bit : 0U; };
    auto out = state_->keyed<plcgw_v1_PairBeat>();
    out.started_ns = static_cast<std::int64_t>(state_->who.started);
    out.role = static_cast<std::uint8_t>(beat.role);
    out.term = beat.term;
    out.priority = beat.priority;
    out.flags =
        static_cast<std::uint8_t>(flag(beat.claims, plcgw_v1_PAIR_CLAIMS) | flag(beat.offers, plcgw_v1_PAIR_OFFERS) |
                                  flag(beat.leaves, plcgw_v1_PAIR_LEAVES) | flag(beat.keeps, plcgw_v1_PAIR_KEEPS));
    out.lines._length = out.lines._maximum = static_cast<std::uint32_t>(count);
    out.lines._buffer = lines.data();
    state_->count(dds_write(state_->beat_writer, &out));
}

void pair_port::publish(const memory_chunk& chunk)
{
    auto out = state_->keyed<plcgw_v1_PairMemory>();
    fill_string(out.plc, chunk.plc);
    out.area = chunk.area;
    out.first = chunk.first;
    out.term = chunk.term;
    lend(out.words, chunk.words);
    state_->count(dds_write(state_->memory_writer, &out));
}

void pair_port::publish(const route_record& route)
{
    auto out = state_->keyed<plcgw_v1_PairRoute>();
    fill_string(out.route, route.route);
    out.writes = route.writes;
    out.term = route.term;
    out.quality = quality_code(route.state);
    out.source_ns = static_cast<std::int64_t>(route.source);
    out.reason_code = route.reason_code;
    out.answers = route.answers;
    out.errors = route.errors;
    fill_string(out.reason, route.reason);
    lend(out.words, route.words);
    state_->count(dds_write(state_->route_writer, &out));
}

std::uint64_t pair_port::drops() const { return state_->drops; }

int pair_port::descriptor() const { return state_->entities.descriptor(); }

std::vector<pair_news> pair_port::take()
{
    state_->entities.read_wakes();
    std::vector<pair_news> news;
    bool more = true;
    while (more && news.size() < most_news)
        more = state_->take_some<plcgw_v1_PairBeat>(state_->beat_reader, news);
    more = true;
    while (more && news.size() < most_news) {
        const bool memory = state_->take_some<plcgw_v1_PairMemory>(state_->memory_reader, news);
        more = state_->take_some<plcgw_v1_PairRoute>(state_->route_reader, news) || memory;
    }
    if (more)
        state_->entities.wake();
    return news;
}

}  // namespace plcgw
