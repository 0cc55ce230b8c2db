#include "bridge/dds/event_text.hpp"

#include "bridge/messages/notation.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace plcgw {
namespace {

constexpr std::size_t longest_message = 200;  // bytes
constexpr std::int64_t second_ns = 1'000'000'000;

std::string line(const received_block& e)
{
    const auto& v = e.value;
    return fmt::format("{} {} {} {} {}: {}", iso_time(v.source), printable(e.gateway), printable(v.route),
                       register_text(v.area, v.first, v.count), to_string(v.state), values_text(v));
}

std::string line(const received_point& e)
{
    return fmt::format("{} {} {} {}: {}", iso_time(e.source), printable(e.gateway), printable(e.name),
                       to_string(e.state), value_text(e));
}

std::string line(const received_status& e)
{
    return fmt::format("gateway {}, member {}: {}", printable(e.who.gateway), printable(e.who.member), status_text(e));
}

std::string line(const received_port& e)
{
    const port_status& s = e.status;
    return fmt::format("{} port {}: {}", printable(e.gateway), printable(s.port), port_text(s));
}

std::string line(const received_device& e)
{
    const device_status& s = e.status;
    return fmt::format("{} device {} on {}: {}", printable(e.gateway), printable(s.device), printable(s.port),
                       device_text(s));
}

std::string line(const received_event& e)
{
    return fmt::format("{} {} {} {} {}: {}", iso_time(e.when), printable(e.gateway), to_string(e.level),
                       printable(e.code), printable(e.subject), printable(e.text));
}

std::string line(const received_message& e)
{
    const auto& v = e.value;
    return fmt::format("{} {} {} {} {}: {}{}", iso_time(v.when), printable(e.gateway), printable(v.line),
                       to_string(v.way), v.name.empty() ? "-" : printable(v.name),
                       messages::printable(v.content, longest_message),
                       v.reason.empty() ? "" : " REFUSED: " + printable(v.reason));
}

std::string line(const gone_block& e)
{
    return fmt::format("- {} {} {} gone: {}", printable(e.gateway), printable(e.route),
                       register_text(e.area, e.first, 1), to_string(e.reason));
}

std::string line(const gone_point& e)
{
    return fmt::format("- {} {} gone: {}", printable(e.gateway), printable(e.name), to_string(e.reason));
}

std::string line(const gone_port& e)
{
    return fmt::format("- {} port {} gone: {}", printable(e.gateway), printable(e.port), to_string(e.reason));
}

std::string line(const gone_device& e)
{
    return fmt::format("- {} device {} gone: {}", printable(e.gateway), printable(e.device), to_string(e.reason));
}

std::string line(const gone_gateway& e)
{
    return fmt::format("gateway {}, member {}: gone: {}", printable(e.gateway), printable(e.member),
                       to_string(e.reason));
}

}  // namespace

std::string iso_time(wall_time t)
{
    if (t == wall_time::never)
        return "never";
    const auto ns = static_cast<std::int64_t>(t);
    std::int64_t seconds = ns / second_ns;
    std::int64_t rest = ns % second_ns;
    if (rest < 0) {
        --seconds;
        rest += second_ns;
    }
    const std::time_t time = seconds;
    std::tm utc{};
    ::gmtime_r(&time, &utc);
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", utc, rest / 1'000'000);
}

std::string age_text(wall_time then, wall_time now)
{
    if (then == wall_time::never)
        return "-";
    // Clocks of two machines may differ: nothing is younger than now. A foreign time may be any number.
    const double seconds =
        std::max(0.0, (static_cast<double>(now) - static_cast<double>(then)) / static_cast<double>(second_ns));
    if (seconds < 10)
        return fmt::format("{:.1f} s", seconds);
    if (seconds < 120)
        return fmt::format("{:.0f} s", seconds);
    if (seconds < 7200)
        return fmt::format("{:.0f} min", seconds / 60);
    if (seconds < 172800)
        return fmt::format("{:.0f} h", seconds / 3600);
    return fmt::format("{:.0f} d", seconds / 86400);
}

std::string printable(const std::string& text)
{
    std::string out = text;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto c = static_cast<unsigned char>(out[i]);
        const auto next = i + 1 < out.size() ? static_cast<unsigned char>(out[i + 1]) : 0U;
        const bool c1 = c == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080..U+009F in UTF-8
        if (c < 0x20 || c == 0x7F || c1)
            out[i] = '?';
        if (c1)
            out.erase(i + 1, 1);
    }
    return out;
}

std::vector<std::uint16_t> values_of(const sample& s)
{
    if (s.format == sample_format::words)
        return s.words;
    std::vector<std::uint16_t> bits;
    const std::size_t count = std::min<std::size_t>(s.count, s.words.size() * 16);
    for (std::size_t i = 0; i < count; ++i)
        bits.push_back(s.words[i / 16] >> (i % 16) & 1U);
    return bits;
}

std::string values_text(const sample& s)
{
    return fmt::format("{}", fmt::join(values_of(s), s.format == sample_format::words ? " " : ""));
}

std::string value_text(const received_point& p)
{
    const std::string unit = p.unit.empty() ? std::string() : " " + printable(p.unit);
    switch (p.value.kind) {
    case point_kind::none: break;
    case point_kind::boolean: return p.value.integer != 0 ? "on" : "off";
    case point_kind::integer: return std::to_string(p.value.integer) + unit;
    case point_kind::real: return fmt::format("{}{}", p.value.real, unit);
    case point_kind::text: return printable(p.value.text);
    }
    return "-";
}

std::string_view to_string(point_kind kind)
{
    switch (kind) {
    case point_kind::none: break;
    case point_kind::boolean: return "bool";
    case point_kind::integer: return "integer";
    case point_kind::real: return "real";
    case point_kind::text: return "text";
    }
    return "none";
}

std::string register_text(const std::string& area, std::uint32_t first, std::uint32_t count)
{
    if (count < 2)
        return fmt::format("{} {}", printable(area), first);
    return fmt::format("{} {}..{}", printable(area), first, std::uint64_t{first} + count - 1);
}

std::string status_text(const received_status& s)
{
    return fmt::format("{}, routes {}/{} up", to_string(s.status.role), s.status.routes_up, s.status.routes_total);
}

std::string port_text(const port_status& s)
{
    return fmt::format("{} since {}, {} frames in, {} out, {} errors, {} reopens{}", to_string(s.state),
                       iso_time(s.since), s.rx_frames, s.tx_frames, s.errors, s.reopens,
                       s.detail.empty() ? "" : " (" + printable(s.detail) + ")");
}

std::string device_text(const device_status& s)
{
    const auto ms = [](std::uint32_t us) { return us == 0 ? "-" : fmt::format("{:.1f} ms", us / 1000.0); };
    return fmt::format("{} since {}, {} requests, {} timeouts, {} exceptions, answers in {}, cycle {}{}",
                       to_string(s.state), iso_time(s.since), s.requests, s.timeouts, s.exceptions, ms(s.rtt_us),
                       ms(s.cycle_us), s.detail.empty() ? "" : " (" + printable(s.detail) + ")");
}

std::string_view to_string(gone_reason reason) { return reason == gone_reason::disposed ? "disposed" : "writer lost"; }

std::string_view to_string(message_direction way) { return way == message_direction::sent ? "sent" : "received"; }

std::string line_of(const dds_event& event)
{
    return std::visit([](const auto& e) { return line(e); }, event);
}

}  // namespace plcgw
