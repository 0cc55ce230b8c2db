#include "daemon/write_service.hpp"

#include "daemon/station_access.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plcgw {
namespace {

order_outcome rejected(std::string why) { return {order_result::rejected, 0, std::move(why)}; }
order_outcome not_found(std::string why) { return {order_result::not_found, 0, std::move(why)}; }

order_outcome expired()
{
    return {order_result::expired, 0,
            "it did not begin within its timeout, nothing was written: the line is busy, or the clock that said when "
            "it was given differs from the gateway's"};
}

order_outcome outcome_of(const point_refusal& why)
{
    return why.why == point_fault::unknown ? not_found(why.text) : rejected(why.text);
}

// What a route did not achieve.
order_outcome outcome_of(const client_line::through_outcome& failure)
{
    const std::string_view then = failure.goes_on ? "; the route goes on trying" : "; it is not tried again";
    if (failure.device_code != 0)
        return {order_result::device_error, failure.device_code, failure.reason + std::string(then)};
    return {order_result::timeout, 0, failure.reason + ": what the device has is not known" + std::string(then)};
}

}  // namespace

found_span write_service::find(const route_order& o, order_origin from) const
{
    std::optional<found_span> found;
    for (const auto& line : of_.lines)
        for (std::size_t i = 0; i < line->routes.rows(); ++i) {
            const route& r = line->routes.route_at(i);
            if (r.name == o.route && (!found || writes(r.way)))  // of one that reads and writes the half that writes
                found = part_of(r, o);
        }
    if (found)
        return *found;
    if (const auto published = of_.blocks.find(o.route); published.block != nullptr) {
        if (from == order_origin::dds && !published.writable)
            return rejected(
                fmt::format("block \"{}\" is read-only: \"writable\" in the configuration allows writing", o.route));
        return part_of(*published.block, o);
    }
    for (const auto& line : of_.messages)
        for (const plc_block& each : line->content.filled())
            if (each.name == o.route)
                return rejected(
                    fmt::format("\"{}\" is read-only: messages of line {} fill it", o.route, line->content.name()));
    return not_found(fmt::format("there is no route or block \"{}\"", o.route));
}

found_span write_service::find(const device_order& o) const
{
    for (const auto& plc : of_.plcs)
        if (plc->name() == o.plc)
            return devices_of(*plc, o);
    return not_found(fmt::format("there is no PLC \"{}\"", o.plc));
}

boost::system::result<memory_write, order_outcome> write_service::write_memory(const order_content& what,
                                                                               order_origin from)
{
    if (const auto* const point = std::get_if<point_order>(&what))
        return write_point(*point);
    const auto* const part = std::get_if<route_order>(&what);
    const found_span span = part != nullptr ? find(*part, from) : find(std::get<device_order>(what));
    if (!span)
        return span.error();
    memory_write made(*span);
    made.write(part != nullptr ? part->values : std::get<device_order>(what).values);
    made.written();
    return made;
}

boost::system::result<memory_write, order_outcome> write_service::write_point(const point_order& o)
{
    const point_table& table = of_.points.table();
    const auto index = table.find(o.name);
    if (!index)
        return not_found("there is no point \"" + o.name + "\"");
    const point& p = table.at(*index);
    const write_span span{p.plc, p.at, bits_of(p)};
    if (p.writable && !p.plc->memory().is_open(span.at, span.bits))
        return rejected("point \"" + o.name + "\" has devices that only the PLC itself sets");
    memory_write made(span);
    if (const auto refused = of_.points.table().write(o.name, o.value))
        return outcome_of(*refused);
    made.written();
    return made;
}

asio::awaitable<order_outcome> write_service::carry_out(order what, order_origin from)
{
    const time_point latest = begin_by(what, now(), wall_now());
    if (now() >= latest)
        co_return expired();
    if (auto* const message = std::get_if<message_order>(&what.what)) {
        message_order o = std::move(*message);
        auto outcome = co_await send(std::move(o), latest, from);
        co_return outcome;
    }
    if (auto* const station = std::get_if<station_order>(&what.what)) {
        station_order o = std::move(*station);
        auto outcome = co_await ask_station(std::move(o), latest);
        co_return outcome;
    }
    auto written = write_memory(what.what, from);
    if (!written)
        co_return written.error();
    memory_write in_memory = std::move(*written);
    auto outcome = co_await await_stations(std::move(in_memory), latest);
    co_return outcome;
}

asio::awaitable<order_outcome> write_service::await_stations(memory_write written, time_point begin_by)
{
    const auto begun = of_.through.begin(*written.span().plc, written.change());
    settle_();
    bool in_time = true;
    if (begun)
        in_time = co_await of_.through.finish_or_expire(begun, begin_by);
    if (!in_time) {
        written.take_back();
        of_.through.withdraw(begun);
    }
    written.end();
    settle_();
    if (!in_time)
        co_return expired();
    if (begun && begun->failed)
        co_return outcome_of(begun->failure);
    const char* const who = begun ? "the station has it" : "the PLC's memory has it; no route takes it to a station";
    co_return order_outcome{order_result::ok, 0, who + overwriting(written.span())};
}

// Who would not see it for long is told.
std::string write_service::overwriting(const write_span& span) const
{
    for (const auto& line : of_.lines)
        for (std::size_t i = 0; i < line->routes.rows(); ++i) {
            const route& r = line->routes.route_at(i);
            const bool both_ways = i + 1 < line->routes.rows() && line->routes.is_half(i + 1);
            if (r.way == direction::read && !both_ways && touches(r, *span.plc, {span.at.area, span.at.bit, span.bits}))
                return fmt::format("; route \"{}\" reads into these devices and replaces it", r.name);
        }
    return {};
}

asio::awaitable<order_outcome> write_service::ask_station(station_order o, time_point begin_by)
{
    const auto line = std::find_if(of_.lines.begin(), of_.lines.end(),
                                   [&](const auto& each) { return each->routes.name() == o.line; });
    if (line == of_.lines.end())
        co_return not_found(fmt::format("there is no client line \"{}\" with stations", o.line));
    auto outcome = co_await write_station(**line, std::move(o), begin_by);
    settle_();
    co_return outcome;
}

asio::awaitable<order_outcome> write_service::send(message_order o, time_point begin_by, order_origin from)
{
    const auto found = std::find_if(of_.messages.begin(), of_.messages.end(),
                                    [&](const auto& each) { return each->content.name() == o.line; });
    if (found == of_.messages.end())
        co_return not_found(fmt::format("there is no general-purpose line \"{}\"", o.line));
    message_line& line = **found;
    if (from == order_origin::dds && !line.allows_dds())
        co_return order_outcome{order_result::denied, 0,
                                fmt::format("line \"{}\" takes no messages by DDS: general_purpose/dds_sends in the "
                                            "configuration allows it",
                                            o.line)};
    if (!line.content.can_send(o.content))
        co_return rejected("with its codes a message has 1 to 4096 bytes");
    const auto number = line.content.order(std::move(o.content), now());
    if (!number)
        co_return order_outcome{order_result::busy, 0, "too many messages wait on this line: repeat it later"};
    const auto entry = std::make_shared<sending>(executor_);
    sendings_.emplace(std::pair(&line, *number), entry);
    line.wake();
    deliver(line);
    while (!entry->outcome) {
        const bool has_begun = line.content.has_begun(*number);
        if (!has_begun && now() >= begin_by) {
            line.content.withdraw(*number);
            sendings_.erase({&line, *number});
            co_return expired();
        }
        entry->done.expires_at(has_begun ? now() + std::chrono::hours(1) : begin_by);
        co_await entry->done.async_wait(no_throw);
    }
    if (entry->outcome->failed)
        co_return order_outcome{order_result::timeout, 0, entry->outcome->reason};
    co_return order_outcome{order_result::ok, 0, "the message is on the line"};
}

void write_service::deliver(message_line& line)
{
    for (client_line::through_outcome& each : line.content.take_ordered()) {
        const auto found = sendings_.find({&line, each.number});
        if (found == sendings_.end())
            continue;
        found->second->outcome = std::move(each);
        found->second->done.cancel();
        sendings_.erase(found);
    }
}

}  // namespace plcgw
