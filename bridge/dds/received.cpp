// What came, from Cyclone's structs to ours. Foreign writers send what they like: numbers out of range stay harmless.
#include "bridge/dds/received.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/quality_code.hpp"

namespace plcgw {
namespace {

std::string text(std::span<const char> in) { return std::string(read_string(in)); }

link_state state_from(std::uint8_t code)
{
    return code <= plcgw_v1_STATE_DEGRADED ? link_state{code} : link_state::unknown;
}

}  // namespace

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

dds_event received(const plcgw_v1_PortStatus& in)
{
    received_port out{text(in.gateway), text(in.member), {}};
    out.status = {.port = text(in.port),
                  .state = state_from(in.state),
                  .since = wall_time{in.since_ns},
                  .rx_frames = in.rx_frames,
                  .tx_frames = in.tx_frames,
                  .rx_bytes = in.rx_bytes,
                  .tx_bytes = in.tx_bytes,
                  .errors = in.errors,
                  .reopens = in.reopens,
                  .detail = text(in.detail)};
    return out;
}

dds_event received(const plcgw_v1_DeviceStatus& in)
{
    received_device out{text(in.gateway), text(in.member), {}};
    out.status = {.device = text(in.device),
                  .port = text(in.port),
                  .state = state_from(in.state),
                  .since = wall_time{in.since_ns},
                  .last_ok = wall_time{in.last_ok_ns},
                  .requests = in.requests,
                  .timeouts = in.timeouts,
                  .exceptions = in.exceptions,
                  .rtt_us = in.rtt_us,
                  .cycle_us = in.cycle_us,
                  .detail = text(in.detail)};
    return out;
}

dds_event received(const plcgw_v1_Event& in)
{
    received_event out{text(in.gateway), text(in.member), in.event_id, wall_time{in.source_ns}, {}, {}, {}, {}};
    out.level =
        in.severity <= plcgw_v1_SEVERITY_ERROR ? line_event::severity{in.severity} : line_event::severity::error;
    out.code = text(in.code);
    out.subject = text(in.subject);
    out.text = text(in.text);
    return out;
}

dds_event gone(const plcgw_v1_PortStatus& key, gone_reason reason)
{
    return gone_port{text(key.gateway), text(key.port), reason};
}

dds_event gone(const plcgw_v1_DeviceStatus& key, gone_reason reason)
{
    return gone_device{text(key.gateway), text(key.device), reason};
}

}  // namespace plcgw
