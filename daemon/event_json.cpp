#include "daemon/event_json.hpp"

#include "bridge/dds/event_text.hpp"
#include "bridge/messages/notation.hpp"

#include <nlohmann/json.hpp>

namespace plcgw {
namespace {

using json = nlohmann::ordered_json;

json time_json(wall_time t) { return t == wall_time::never ? json() : json(iso_time(t)); }

json json_of(const received_block& e)
{
    const auto& v = e.value;
    return {{"event", "registers"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"route", v.route},
            {"area", v.area},
            {"first", v.first},
            {"format", v.format == sample_format::bits ? "bits" : "words"},
            {"count", v.count},
            {"values", values_of(v)},
            {"quality", to_string(v.state)},
            {"quality_code", e.code},
            {"source_time", time_json(v.source)},
            {"source_ns", static_cast<std::int64_t>(v.source)},
            {"seq", e.seq}};
}

json json_of(const received_point& e)
{
    const point_value& v = e.value;
    json value;
    if (v.kind == point_kind::boolean)
        value = v.integer != 0;
    else if (v.kind == point_kind::integer)
        value = v.integer;
    else if (v.kind == point_kind::real)
        value = v.real;
    else if (v.kind == point_kind::text)
        value = v.text;
    return {{"event", "point"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"name", e.name},
            {"kind", to_string(v.kind)},
            {"value", std::move(value)},
            {"unit", e.unit},
            {"quality", to_string(e.state)},
            {"quality_code", e.code},
            {"source_time", time_json(e.source)},
            {"source_ns", static_cast<std::int64_t>(e.source)},
            {"seq", e.seq}};
}

json json_of(const received_status& e)
{
    const auto& s = e.status;
    return {{"event", "status"},
            {"gateway", e.who.gateway},
            {"member", e.who.member},
            {"role", to_string(s.role)},
            {"strength", s.strength},
            {"started", time_json(s.started)},
            {"started_ns", static_cast<std::int64_t>(s.started)},
            {"beat", e.beat},
            {"routes_up", s.routes_up},
            {"routes_total", s.routes_total},
            {"version", e.who.version},
            {"config_hash", e.who.config_hash}};
}

json json_of(const received_message& e)
{
    const auto& v = e.value;
    return {{"event", "message"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"line", v.line},
            {"way", to_string(v.way)},
            {"name", v.name},
            {"text", messages::printable(v.content)},
            {"refused", v.reason.empty() ? json() : json(v.reason)},
            {"source_time", iso_time(v.when)},
            {"source_ns", static_cast<std::int64_t>(v.when)},
            {"seq", e.seq}};
}

json json_of(const received_port& e)
{
    const port_status& s = e.status;
    return {{"event", "port"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"port", s.port},
            {"state", to_string(s.state)},
            {"since", time_json(s.since)},
            {"since_ns", static_cast<std::int64_t>(s.since)},
            {"rx_frames", s.rx_frames},
            {"tx_frames", s.tx_frames},
            {"rx_bytes", s.rx_bytes},
            {"tx_bytes", s.tx_bytes},
            {"errors", s.errors},
            {"reopens", s.reopens},
            {"detail", s.detail}};
}

json json_of(const received_device& e)
{
    const device_status& s = e.status;
    return {{"event", "device"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"device", s.device},
            {"port", s.port},
            {"state", to_string(s.state)},
            {"since", time_json(s.since)},
            {"since_ns", static_cast<std::int64_t>(s.since)},
            {"last_ok", time_json(s.last_ok)},
            {"last_ok_ns", static_cast<std::int64_t>(s.last_ok)},
            {"requests", s.requests},
            {"timeouts", s.timeouts},
            {"exceptions", s.exceptions},
            {"rtt_us", s.rtt_us},
            {"cycle_us", s.cycle_us},
            {"detail", s.detail}};
}

json json_of(const received_event& e)
{
    return {{"event", "event"},
            {"gateway", e.gateway},
            {"member", e.member},
            {"id", e.id},
            {"source_time", time_json(e.when)},
            {"source_ns", static_cast<std::int64_t>(e.when)},
            {"severity", to_string(e.level)},
            {"code", e.code},
            {"subject", e.subject},
            {"text", e.text}};
}

json json_of(const gone_block& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"route", e.route},
            {"area", e.area},  {"first", e.first},     {"reason", to_string(e.reason)}};
}

json json_of(const gone_point& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"point", e.name}, {"reason", to_string(e.reason)}};
}

json json_of(const gone_port& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"port", e.port}, {"reason", to_string(e.reason)}};
}

json json_of(const gone_device& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"device", e.device}, {"reason", to_string(e.reason)}};
}

json json_of(const gone_gateway& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"member", e.member}, {"reason", to_string(e.reason)}};
}

}  // namespace

std::string json_line(const dds_event& event)
{
    const json object = std::visit([](const auto& e) { return json_of(e); }, event);
    return object.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace plcgw
