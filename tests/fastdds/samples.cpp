#include "tests/fastdds/samples.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace fast_dds {
namespace {

using namespace plcgw::v1;

template <std::size_t Bound>
std::string text(const eprosima::fastrtps::fixed_string<Bound>& from)
{
    return from.c_str();
}

std::string text(const json& from, const char* name) { return from.value(name, std::string()); }

}  // namespace

json fields(const RegisterBlock& s)
{
    return {{"gateway", text(s.gateway())}, {"route", text(s.route())},   {"area", text(s.area())},
            {"first", s.first()},           {"member", text(s.member())}, {"seq", s.seq()},
            {"source_ns", s.source_ns()},   {"quality", s.quality()},     {"format", s.format()},
            {"count", s.count()},           {"words", s.words()}};
}

json fields(const Point& s)
{
    return {{"gateway", text(s.gateway())}, {"name", text(s.name())}, {"member", text(s.member())}, {"seq", s.seq()},
            {"source_ns", s.source_ns()},   {"quality", s.quality()}, {"kind", s.kind()},           {"real", s.real()},
            {"integer", s.integer()},       {"text", text(s.text())}, {"unit", text(s.unit())}};
}

json fields(const PortStatus& s)
{
    return {{"gateway", text(s.gateway())}, {"port", text(s.port())},   {"member", text(s.member())},
            {"state", s.state()},           {"since_ns", s.since_ns()}, {"rx_frames", s.rx_frames()},
            {"tx_frames", s.tx_frames()},   {"rx_bytes", s.rx_bytes()}, {"tx_bytes", s.tx_bytes()},
            {"errors", s.errors()},         {"reopens", s.reopens()},   {"detail", text(s.detail())}};
}

json fields(const DeviceStatus& s)
{
    return {{"gateway", text(s.gateway())}, {"device", text(s.device())}, {"member", text(s.member())},
            {"port", text(s.port())},       {"state", s.state()},         {"since_ns", s.since_ns()},
            {"last_ok_ns", s.last_ok_ns()}, {"requests", s.requests()},   {"timeouts", s.timeouts()},
            {"exceptions", s.exceptions()}, {"rtt_us", s.rtt_us()},       {"cycle_us", s.cycle_us()},
            {"detail", text(s.detail())}};
}

json fields(const GatewayStatus& s)
{
    return {{"gateway", text(s.gateway())},
            {"member", text(s.member())},
            {"role", s.role()},
            {"strength", s.strength()},
            {"started_ns", s.started_ns()},
            {"beat", s.beat()},
            {"routes_up", s.routes_up()},
            {"routes_total", s.routes_total()},
            {"version", text(s.version())},
            {"config_hash", text(s.config_hash())}};
}

json fields(const Event& s)
{
    return {{"gateway", text(s.gateway())}, {"member", text(s.member())}, {"event_id", s.event_id()},
            {"source_ns", s.source_ns()},   {"severity", s.severity()},   {"code", text(s.code())},
            {"subject", text(s.subject())}, {"text", text(s.text())}};
}

json fields(const SerialMessage& s)
{
    return {{"gateway", text(s.gateway())}, {"member", text(s.member())},
            {"line", text(s.line())},       {"seq", s.seq()},
            {"source_ns", s.source_ns()},   {"way", s.way()},
            {"name", text(s.name())},       {"reason", text(s.reason())},
            {"content", s.content()}};
}

json fields(const WriteReply& s)
{
    return {{"client", text(s.client())}, {"request_id", s.request_id()}, {"gateway", text(s.gateway())},
            {"member", text(s.member())}, {"result", s.result()},         {"device_code", s.device_code()},
            {"done_ns", s.done_ns()},     {"detail", text(s.detail())}};
}

void fill(WriteRequest& request, const json& from)
{
    request.client(text(from, "client"));
    request.request_id(from.value("request_id", std::uint64_t{}));
    request.gateway(text(from, "gateway"));
    request.route(text(from, "route"));
    request.area(text(from, "area"));
    request.first(from.value("first", std::uint32_t{}));
    request.format(from.value("format", std::uint8_t{}));
    request.count(from.value("count", std::uint32_t{}));
    request.words(from.value("words", std::vector<std::uint16_t>()));
    request.source_ns(from.value("source_ns", std::int64_t{}));
    request.timeout_ms(from.value("timeout_ms", std::uint32_t{}));
}

void fill(PointWriteRequest& request, const json& from)
{
    request.client(text(from, "client"));
    request.request_id(from.value("request_id", std::uint64_t{}));
    request.gateway(text(from, "gateway"));
    request.name(text(from, "name"));
    request.kind(from.value("kind", std::uint8_t{}));
    request.real(from.value("real", 0.0));
    request.integer(from.value("integer", std::int64_t{}));
    request.text(text(from, "text"));
    request.source_ns(from.value("source_ns", std::int64_t{}));
    request.timeout_ms(from.value("timeout_ms", std::uint32_t{}));
}

void fill(SerialSendRequest& request, const json& from)
{
    request.client(text(from, "client"));
    request.request_id(from.value("request_id", std::uint64_t{}));
    request.gateway(text(from, "gateway"));
    request.line(text(from, "line"));
    request.content(from.value("content", std::vector<std::uint8_t>()));
    request.source_ns(from.value("source_ns", std::int64_t{}));
    request.timeout_ms(from.value("timeout_ms", std::uint32_t{}));
}

}  // namespace fast_dds
