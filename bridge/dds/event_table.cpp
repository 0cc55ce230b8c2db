#include "bridge/dds/event_table.hpp"

#include "bridge/dds/event_text.hpp"
#include "bridge/dds/table_row.hpp"
#include "bridge/messages/notation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace plcgw {
namespace {

constexpr std::size_t longest_shown = 200;  // bytes of a message
constexpr auto silent_after_ns = std::int64_t{15} * 1'000'000'000;

std::string clipped(const std::string& text, std::size_t width)
{
    std::size_t characters = 0;
    std::size_t keep = 0;  // bytes of the first width - 3 characters
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U)
            continue;
        if (characters + 3 == width)
            keep = i;
        if (++characters > width)
            return width < 3 ? std::string(width, '.') : text.substr(0, keep) + "...";
    }
    return text;
}

line_style style_of(quality q)
{
    switch (q) {
    case quality::good: return line_style::plain;
    case quality::stale:
    case quality::substituted:
    case quality::out_of_limits: return line_style::warning;
    case quality::comm_error:
    case quality::device_error:
    case quality::no_value: return line_style::error;
    case quality::never_read: break;
    }
    return line_style::old;
}

}  // namespace

std::string row_text(char mark, const std::string& route, const std::string& registers, std::string_view quality,
                     const std::string& age, const std::string& values)
{
    return fmt::format("{} {:<20} {:<18} {:<12} {:>7}  {}", mark, route, registers, quality, age, values);
}

bool event_table::apply(const dds_event& event, wall_time now)
{
    return std::visit([&](const auto& e) { return apply_one(e, now); }, event);
}

bool event_table::apply_one(const received_block& e, wall_time)
{
    auto& row = blocks_[{e.gateway, e.value.route, e.value.area, e.value.first}];
    const auto seen = [](const block_row& r) { return std::tie(r.last.code, r.last.value.count, r.last.value.words); };
    const block_row next{e, writer::alive};
    const bool changed = row.state != next.state || seen(row) != seen(next);
    row = next;
    return changed;
}

bool event_table::apply_one(const received_point& e, wall_time)
{
    auto& row = points_[{e.gateway, e.name}];
    const bool changed =
        row.state == writer::lost || row.last.name.empty() || row.last.code != e.code || row.last.value != e.value;
    row = {e, writer::alive};
    return changed;
}

bool event_table::apply_one(const gone_point& e, wall_time)
{
    const auto row = points_.find({e.gateway, e.name});
    if (row == points_.end())
        return false;
    if (e.reason == gone_reason::disposed)
        points_.erase(row);
    else
        row->second.state = writer::lost;
    return true;
}

bool event_table::apply_one(const received_status& e, wall_time now)
{
    auto& row = members_[{e.who.gateway, e.who.member}];
    const bool changed = row.state == writer::lost || row.last.who != e.who || row.last.status != e.status;
    row = {e, now, writer::alive};
    return changed;
}

// Each is news, the same text once more, too.
bool event_table::apply_one(const received_message& e, wall_time)
{
    messages_.insert_or_assign({e.gateway, e.value.line, e.value.way, e.value.name}, e);
    return true;
}

bool event_table::apply_one(const gone_block& e, wall_time)
{
    const auto row = blocks_.find({e.gateway, e.route, e.area, e.first});
    if (row == blocks_.end())
        return false;
    if (e.reason == gone_reason::disposed)
        blocks_.erase(row);
    else
        row->second.state = writer::lost;
    return true;
}

bool event_table::apply_one(const gone_gateway& e, wall_time now)
{
    const auto row = members_.find({e.gateway, e.member});
    if (row == members_.end())
        return false;
    row->second.state = writer::lost;
    row->second.heard = now;
    return true;
}

std::vector<table_line> event_table::lines(wall_time now, std::size_t width, std::size_t height) const
{
    std::set<std::string> gateways;
    for (const auto& [key, row] : members_)
        gateways.insert(std::get<0>(key));
    for (const auto& [key, row] : blocks_)
        gateways.insert(std::get<0>(key));
    for (const auto& [key, row] : points_)
        gateways.insert(key.first);
    for (const auto& [key, row] : messages_)
        gateways.insert(std::get<0>(key));
    for (const auto& [key, row] : ports_)
        gateways.insert(key.first);
    for (const auto& [key, row] : devices_)
        gateways.insert(key.first);

    std::vector<table_line> out;
    for (const auto& gateway : gateways)
        gateway_lines(gateway, now, out);

    if (out.size() > height) {
        const std::size_t hidden = out.size() - height + 1;
        out.resize(height);
        if (height > 0)
            out.back() = {line_style::plain, fmt::format("... {} more lines", hidden)};
    }
    for (auto& line : out)
        line.text = clipped(line.text, width);
    return out;
}

void event_table::gateway_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const
{
    bool known = false;
    for (const auto& [key, row] : members_) {
        if (std::get<0>(key) != gateway)
            continue;
        known = true;
        const std::string name = fmt::format("gateway {}, member {} {}", printable(gateway),
                                             printable(row.last.who.member), printable(row.last.who.version));
        const std::string age = age_text(row.heard, now);
        if (row.state == writer::lost) {
            out.push_back({line_style::error, fmt::format("{}: GATEWAY GONE since {}", name, age)});
            continue;
        }
        const bool silent = static_cast<std::int64_t>(now) - static_cast<std::int64_t>(row.heard) > silent_after_ns;
        const bool down = row.last.status.routes_up < row.last.status.routes_total;
        out.push_back({silent || down ? line_style::warning : line_style::heading,
                       fmt::format("{}: {}, beat {}, {}{}", name, status_text(row.last), row.last.beat,
                                   silent ? "SILENT for " : "heard ", silent ? age : age + " ago")});
    }
    if (!known)
        out.push_back({line_style::warning, fmt::format("gateway {}: no status", printable(gateway))});

    port_lines(gateway, now, out);
    device_lines(gateway, now, out);
    out.push_back({line_style::heading, row_text(' ', "ROUTE", "REGISTERS", "QUALITY", "AGE", "VALUES")});
    for (const auto& [key, row] : blocks_) {
        if (std::get<0>(key) != gateway)
            continue;
        const auto& v = row.last.value;
        const bool lost = row.state == writer::lost;
        const char mark = lost ? 'x' : v.state == quality::good ? ' ' : '!';
        out.push_back({lost ? line_style::old : style_of(v.state),
                       row_text(mark, printable(v.route), register_text(v.area, v.first, v.count),
                                lost ? "gone" : to_string(v.state), age_text(v.source, now), values_text(v))});
    }
    point_lines(gateway, now, out);
    message_lines(gateway, now, out);
    event_lines(gateway, out);
}

void event_table::point_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const
{
    bool headed = false;
    for (const auto& [key, row] : points_) {
        if (key.first != gateway)
            continue;
        if (!std::exchange(headed, true))
            out.push_back({line_style::heading, row_text(' ', "POINT", "", "QUALITY", "AGE", "VALUE")});
        const received_point& p = row.last;
        const bool lost = row.state == writer::lost;
        const char mark = lost ? 'x' : p.state == quality::good ? ' ' : '!';
        out.push_back({lost ? line_style::old : style_of(p.state),
                       row_text(mark, printable(p.name), "", lost ? "gone" : to_string(p.state),
                                age_text(p.source, now), value_text(p))});
    }
}

void event_table::message_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const
{
    bool headed = false;
    for (const auto& [key, row] : messages_) {
        if (std::get<0>(key) != gateway)
            continue;
        if (!std::exchange(headed, true))
            out.push_back({line_style::heading, row_text(' ', "LINE", "MESSAGE", "WAY", "AGE", "TEXT")});
        const serial_message& v = row.value;
        const bool refused = !v.reason.empty();
        out.push_back({refused ? line_style::warning : line_style::plain,
                       row_text(refused ? '!' : ' ', printable(v.line), v.name.empty() ? "-" : printable(v.name),
                                refused ? "refused" : to_string(v.way), age_text(v.when, now),
                                messages::printable(v.content, longest_shown))});
    }
}

}  // namespace plcgw
