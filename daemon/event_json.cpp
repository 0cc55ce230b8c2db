#include "daemon/event_json.hpp"

#include "bridge/dds/event_text.hpp"
#include "bridge/messages/notation.hpp"

#include <nlohmann/json.hpp>

namespace plcgw {
namespace {

using json = nlohmann::ordered_json;

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
            {"source_time", v.source == wall_time::never ? json() : json(iso_time(v.source))},
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
            {"source_time", e.source == wall_time::never ? json() : json(iso_time(e.source))},
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
            {"started", s.started == wall_time::never ? json() : json(iso_time(s.started))},
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

json json_of(const gone_block& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"route", e.route},
            {"area", e.area},  {"first", e.first},     {"reason", to_string(e.reason)}};
}

json json_of(const gone_point& e)
{
    return {{"event", "gone"}, {"gateway", e.gateway}, {"point", e.name}, {"reason", to_string(e.reason)}};
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
