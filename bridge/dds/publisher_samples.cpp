// What a publisher says of values: registers, points, serial messages.
#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/publisher_state.hpp"
#include "bridge/dds/quality_code.hpp"
#include "messages.h"

namespace plcgw {
namespace {

static_assert(static_cast<int>(point_kind::none) == plcgw_v1_KIND_NONE);
static_assert(static_cast<int>(point_kind::boolean) == plcgw_v1_KIND_BOOLEAN);
static_assert(static_cast<int>(point_kind::integer) == plcgw_v1_KIND_INTEGER);
static_assert(static_cast<int>(point_kind::real) == plcgw_v1_KIND_REAL);
static_assert(static_cast<int>(point_kind::text) == plcgw_v1_KIND_TEXT);

}  // namespace

plcgw_v1_RegisterBlock dds_publisher::state::keyed(const sample& s) const
{
    plcgw_v1_RegisterBlock block{};
    fill_string(block.gateway, who.gateway);
    fill_string(block.route, s.route);
    fill_string(block.area, s.area);
    block.first = s.first;
    return block;
}

void dds_publisher::publish(const sample& s)
{
    auto instance = state_->sequence.find(std::tie(s.route, s.area, s.first));
    if (instance == state_->sequence.end())
        instance = state_->sequence.emplace(state::instance_key(s.route, s.area, s.first), 0).first;

    plcgw_v1_RegisterBlock block = state_->keyed(s);
    fill_string(block.member, state_->who.member);
    block.seq = ++instance->second;
    block.source_ns = static_cast<std::int64_t>(s.source);
    block.quality = quality_code(s.state);
    block.format = s.format == sample_format::bits ? plcgw_v1_FORMAT_BITS : plcgw_v1_FORMAT_WORDS;
    block.count = s.count;
    block.words._length = block.words._maximum = static_cast<std::uint32_t>(s.words.size());
    block.words._buffer = const_cast<std::uint16_t*>(s.words.data());  // dds_write only reads it
    state_->write(dds_topic::register_block, &block);
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
    state_->write(dds_topic::point, &out);
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
    state_->write(dds_topic::serial_message, &out);
}

void dds_publisher::dispose(const sample& key)
{
    const auto instance = state_->sequence.find(std::tie(key.route, key.area, key.first));
    if (instance == state_->sequence.end())
        return;
    state_->sequence.erase(instance);
    const plcgw_v1_RegisterBlock block = state_->keyed(key);
    state_->dispose(dds_topic::register_block, &block);
}

void dds_publisher::dispose(const point_sample& key)
{
    if (state_->points_of.erase(std::string(key.name)) == 0)
        return;
    plcgw_v1_Point out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.name, key.name);
    state_->dispose(dds_topic::point, &out);
}

}  // namespace plcgw
