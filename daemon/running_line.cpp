#include "daemon/running_line.hpp"

#include "daemon/line_connection.hpp"
#include "daemon/mewtocol_line.hpp"
#include "daemon/serial_line.hpp"
#include "daemon/station_reading.hpp"
#include "daemon/tcp_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

std::vector<station> stations_of(const gateway_config& all, const line_config& line)
{
    std::vector<station> stations;
    for (const station_config& each : all.stations)
        if (each.line == line.name)
            stations.push_back({each.name, station_number(each.unit), timing_of(line, each), reading_of(line, each),
                                line.learn_timeout ? std::optional<duration>(line.least_timeout) : std::nullopt});
    return stations;
}

line_options options_of(const gateway_config& all, const line_config& line)
{
    return {.longest_silence = all.dds.longest_silence,
            .timing = timing_of(line),
            .cache_age = line.forward_cache,
            .parallel = line.protocol == line_protocol::modbus_tcp ? line.max_outstanding : 1,
            .numbered_answers = line.protocol == line_protocol::modbus_tcp};
}

std::unique_ptr<line_driver> make_driver(boost::asio::io_context& loop, const line_config& line, client_line& routes,
                                         std::function<void()> settle)
{
    if (line.protocol == line_protocol::modbus_tcp)
        return std::make_unique<tcp_line>(loop, line, routes, std::move(settle));
    if (is_mewtocol(line.protocol))
        return std::make_unique<mewtocol_line>(loop, line, routes, std::move(settle));
    return std::make_unique<serial_line>(loop, line, routes, std::move(settle));
}

status_place place_of(const status_config& from, const std::string& plc_name, const find_plc& plc)
{
    plc::simulated_plc& in = plc(plc_name);
    return {&in, *in.memory().find(*plc::parse_device(from.device, in.model().names)), from.order};
}

}  // namespace

route make_route(const route_config& from, const find_plc& plc)
{
    route r;
    r.name = from.name;
    r.plc = &plc(from.plc);
    r.at = *r.plc->memory().find(*plc::parse_device(from.device, r.plc->model().names));
    r.there = place_of(from);
    r.count = static_cast<std::uint16_t>(from.count);
    r.way = from.way;
    if (from.on_loss != loss_policy::keep)
        r.substitute = packed_values(r, from.on_loss == loss_policy::zero ? std::vector<unsigned>{0} : from.loss_value);
    return r;
}

plc_copy make_copy(const route_config& from, const find_plc& plc)
{
    plc::simulated_plc& source = plc(from.from.plc);
    plc::simulated_plc& target = plc(from.plc);
    const plc::device head = *plc::parse_device(from.from.device, source.model().names);
    return {from.name,
            &source,
            *source.memory().find(head),
            &target,
            *target.memory().find(*plc::parse_device(from.device, target.model().names)),
            plc::is_bit_kind(head.kind) ? from.count : std::size_t{16} * from.count};
}

std::vector<std::uint16_t> packed_values(const route& of, const std::vector<unsigned>& values)
{
    std::vector<std::uint16_t> words((bits_of(of) + 15) / 16);
    for (std::size_t i = 0; i < of.count; ++i) {
        const unsigned value = values.size() == 1 ? values.front() : values[i];
        const std::size_t word = is_bits(of.there) ? i / 16 : i;
        const std::size_t shift = is_bits(of.there) ? i % 16 : 0;
        words[word] = static_cast<std::uint16_t>(words[word] | value << shift);
    }
    return words;
}

modbus::serial_options timing_of(const line_config& line)
{
    return {.format = format_of(line),
            .response_timeout = line.response_timeout,
            .retries = line.retries,
            .turnaround = line.turnaround_delay,
            .gap = line.gap,
            .silence = silence_of(line),
            .echo = echo_of(line),
            .mode = framing_of(line)};
}

modbus::serial_options timing_of(const line_config& line, const station_config& station)
{
    modbus::serial_options timing = timing_of(line);
    timing.response_timeout = station.response_timeout.value_or(line.response_timeout);
    timing.retries = station.retries.value_or(line.retries);
    return timing;
}

running_line::running_line(boost::asio::io_context& loop, const gateway_config& all, const line_config& line,
                           const find_plc& plc, std::function<void()> settle)
    : config(line), routes(line.name, stations_of(all, line), options_of(all, line)),
      driver(make_driver(loop, line, routes, std::move(settle))), gate(loop.get_executor(), routes, *driver)
{
    std::size_t station = 0;
    for (const station_config& each : all.stations) {
        if (each.line != line.name)
            continue;
        units_.push_back(each.unit);
        for (const route_config& from : all.routes) {
            if (from.station != each.name)
                continue;
            const std::size_t row = routes.add_route(make_route(from, plc), station, from.period);
            if (!from.status.device.empty())
                statuses.add_route(row,
                                   place_of(from.status, from.status.plc.empty() ? from.plc : from.status.plc, plc));
        }
        if (!each.status.device.empty())
            statuses.add_station(station, place_of(each.status, each.status.plc, plc));
        ++station;
    }
}

void running_line::remember(const learned_by_station& all)
{
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (const auto found = all.find({config.name, units_[i]}); found != all.end())
            routes.remember(i, found->second);
}

void running_line::tell(learned_by_station& all) const
{
    for (std::size_t i = 0; i < units_.size(); ++i)
        all[{config.name, units_[i]}] = routes.limits_of(i);
}

}  // namespace plcgw
