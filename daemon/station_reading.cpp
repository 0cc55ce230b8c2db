#include "daemon/station_reading.hpp"

#include "daemon/line_connection.hpp"

namespace plcgw {
namespace {

bus_protocol protocol_of(line_protocol p)
{
    switch (p) {
    case line_protocol::modbus_ascii: return bus_protocol::modbus_ascii;
    case line_protocol::modbus_tcp: return bus_protocol::modbus_tcp;
    case line_protocol::mewtocol_com: return bus_protocol::mewtocol_com;
    case line_protocol::mewtocol7_com: return bus_protocol::mewtocol7_com;
    case line_protocol::modbus_rtu:
    case line_protocol::general_purpose: break;
    }
    return bus_protocol::modbus_rtu;
}

}  // namespace

station_place place_of(const route_config& r)
{
    if (r.source.empty())
        return modbus_place{*r.table, modbus::address{static_cast<std::uint16_t>(*r.first)}};
    return *mewtocol::parse_device(r.source);
}

read_settings reading_of(const line_config& line, const station_config& station)
{
    read_settings made{.merge = station.merge, .max_registers = station.max_registers, .max_bits = station.max_bits};
    made.bus.protocol = protocol_of(line.protocol);
    made.bus.format = format_of(line);
    made.bus.gap = line.gap;
    made.bus.headers = line.mewtocol.expansion ? mewtocol::headers::automatic : mewtocol::headers::normal;
    made.bus.dialect = line.mewtocol.dialect;
    if (line.protocol == line_protocol::modbus_tcp)
        made.bus.at_a_time = line.max_outstanding;
    return made;
}

std::vector<station_wants> wants_of(const gateway_config& all, const line_config& line)
{
    std::vector<station_wants> made;
    for (const station_config& station : all.stations) {
        if (station.line != line.name)
            continue;
        station_wants& of = made.emplace_back();
        of.station = &station;
        of.how = reading_of(line, station);
        for (const route_config& each : all.routes) {
            if (each.station != station.name || each.way != direction::read)
                continue;
            of.routes.push_back(&each);
            of.wanted.push_back({place_of(each), each.count, each.period});
        }
    }
    return made;
}

bool polls(const line_config& line)
{
    return line.role == line_role::client && line.protocol != line_protocol::general_purpose;
}

}  // namespace plcgw
