// What a publisher says of the gateway itself: its status, ports, devices and events.
#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/publisher_state.hpp"

namespace plcgw {
namespace {

static_assert(static_cast<int>(link_state::unknown) == plcgw_v1_STATE_UNKNOWN);
static_assert(static_cast<int>(link_state::disabled) == plcgw_v1_STATE_DISABLED);
static_assert(static_cast<int>(link_state::down) == plcgw_v1_STATE_DOWN);
static_assert(static_cast<int>(link_state::starting) == plcgw_v1_STATE_STARTING);
static_assert(static_cast<int>(link_state::up) == plcgw_v1_STATE_UP);
static_assert(static_cast<int>(link_state::degraded) == plcgw_v1_STATE_DEGRADED);
static_assert(static_cast<int>(line_event::severity::info) == plcgw_v1_SEVERITY_INFO);
static_assert(static_cast<int>(line_event::severity::warning) == plcgw_v1_SEVERITY_WARNING);
static_assert(static_cast<int>(line_event::severity::error) == plcgw_v1_SEVERITY_ERROR);

}  // namespace

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
    state_->write(dds_topic::gateway_status, &out);
}

void dds_publisher::publish(const port_status& status)
{
    plcgw_v1_PortStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.port, status.port);
    fill_string(out.member, state_->who.member);
    out.state = static_cast<std::uint8_t>(status.state);
    out.since_ns = static_cast<std::int64_t>(status.since);
    out.rx_frames = status.rx_frames;
    out.tx_frames = status.tx_frames;
    out.rx_bytes = status.rx_bytes;
    out.tx_bytes = status.tx_bytes;
    out.errors = status.errors;
    out.reopens = status.reopens;
    fill_string(out.detail, status.detail);
    state_->write(dds_topic::port_status, &out);
}

void dds_publisher::publish(const device_status& status)
{
    plcgw_v1_DeviceStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.device, status.device);
    fill_string(out.member, state_->who.member);
    fill_string(out.port, status.port);
    out.state = static_cast<std::uint8_t>(status.state);
    out.since_ns = static_cast<std::int64_t>(status.since);
    out.last_ok_ns = static_cast<std::int64_t>(status.last_ok);
    out.requests = status.requests;
    out.timeouts = status.timeouts;
    out.exceptions = status.exceptions;
    out.rtt_us = status.rtt_us;
    out.cycle_us = status.cycle_us;
    fill_string(out.detail, status.detail);
    state_->write(dds_topic::device_status, &out);
}

void dds_publisher::publish(const line_event& event, wall_time when)
{
    plcgw_v1_Event out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.member, state_->who.member);
    out.event_id = ++state_->events;
    out.source_ns = static_cast<std::int64_t>(when);
    out.severity = static_cast<std::uint8_t>(event.level);
    fill_string(out.code, event.code);
    fill_string(out.subject, event.subject);
    fill_string(out.text, event.text);
    state_->write(dds_topic::event, &out);
}

void dds_publisher::dispose(const port_status& key)
{
    plcgw_v1_PortStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.port, key.port);
    state_->dispose(dds_topic::port_status, &out);
}

void dds_publisher::dispose(const device_status& key)
{
    plcgw_v1_DeviceStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.device, key.device);
    state_->dispose(dds_topic::device_status, &out);
}

void dds_publisher::dispose_gateway()
{
    plcgw_v1_GatewayStatus out{};
    fill_string(out.gateway, state_->who.gateway);
    fill_string(out.member, state_->who.member);
    state_->dispose(dds_topic::gateway_status, &out);
}

}  // namespace plcgw
