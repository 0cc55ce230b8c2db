#include "daemon/server_line.hpp"

#include "daemon/line_connection.hpp"
#include "daemon/mewtocol_server.hpp"
#include "daemon/serial_server.hpp"

namespace plcgw {
namespace {

std::unique_ptr<line_driver> make_modbus(asio::io_context& loop, const line_config& line, const find_plc& plc,
                                         const find_gate& gate, fp7_ports& ports, std::function<void()> settle)
{
    std::vector<modbus_station> stations;
    std::vector<serial_forwarder::way> ways;
    for (const unit_config& each : line.units) {
        if (!each.line.empty()) {
            ways.push_back({modbus::unit_id{static_cast<std::uint8_t>(each.unit)}, &gate(each.line),
                            station_number(each.line_unit == 0 ? each.unit : each.line_unit)});
            continue;
        }
        stations.emplace_back(plc(each.plc), modbus::unit_id{static_cast<std::uint8_t>(each.unit)}, each.channel);
        plc(each.plc).attach(each.channel, shown_line(line, plc::role::server, each.unit));
    }
    auto made = std::make_unique<serial_server>(loop, line, std::move(stations), serial_forwarder(std::move(ways)),
                                                std::move(settle));
    for (const unit_config& each : line.units)
        if (!each.plc.empty())
            made->ports().add(
                ports.open(plc(each.plc), each.channel, line, each.unit, [line = made.get()] { line->reset(); }),
                each.channel);
    return made;
}

std::unique_ptr<line_driver> make_mewtocol(asio::io_context& loop, const line_config& line, const find_plc& plc,
                                           fp7_ports& ports, std::function<void()> settle)
{
    std::vector<mewtocol_station> stations;
    for (const unit_config& each : line.units)
        stations.emplace_back(plc(each.plc), station_options_of(line, each.unit, stations.empty()));
    auto made = std::make_unique<mewtocol_server>(loop, line, std::move(stations), std::move(settle));
    for (std::size_t i = 0; i < line.units.size(); ++i) {
        const unit_config& each = line.units[i];
        made->ports().add(
            ports.open(plc(each.plc), each.channel, line, each.unit, [line = made.get(), i] { line->reset(i); }),
            each.channel);
    }
    return made;
}

}  // namespace

plc::channel_line shown_line(const line_config& line, plc::role as, unsigned unit)
{
    plc::channel_line shown{.as = as, .station = static_cast<std::uint8_t>(unit), .rs485 = line.rs485.enabled};
    if (line.protocol != line_protocol::modbus_tcp)
        shown.format = format_of(line);
    if (line.protocol == line_protocol::modbus_ascii)
        shown.mode = plc::framing::ascii;
    return shown;
}

std::unique_ptr<line_driver> make_server_line(asio::io_context& loop, const line_config& line, const find_plc& plc,
                                              const find_gate& gate, fp7_ports& ports, std::function<void()> settle)
{
    return is_mewtocol(line.protocol) ? make_mewtocol(loop, line, plc, ports, std::move(settle))
                                      : make_modbus(loop, line, plc, gate, ports, std::move(settle));
}

}  // namespace plcgw
