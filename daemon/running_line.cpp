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
            stations.push_back({each.name, station_number(each.unit), timing_of(line, each), reading_of(line, each)});
    return stations;
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

route make_route(const route_config& from, const find_plc& plc)
{
    route r;
    r.name = from.name;
    r.plc = &plc(from.plc);
    r.at = *r.plc->memory().find(*plc::parse_device(from.device, r.plc->model().names));
    r.there = place_of(from);
    r.count = static_cast<std::uint16_t>(from.count);
    r.way = from.way;
    return r;
}

}  // namespace

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
    : config(line), routes(line.name, stations_of(all, line), all.dds.longest_silence, timing_of(line)),
      driver(make_driver(loop, line, routes, std::move(settle))), gate(loop.get_executor(), routes, *driver)
{
    std::size_t station = 0;
    for (const station_config& each : all.stations) {
        if (each.line != line.name)
            continue;
        units_.push_back(each.unit);
        for (const route_config& from : all.routes)
            if (from.station == each.name)
                routes.add_route(make_route(from, plc), station, from.period);
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
