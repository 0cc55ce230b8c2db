#include "daemon/fp7_ports.hpp"

#include "bridge/plc/models/fp7.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/line_connection.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned link_port = 1;        // COM.1
constexpr unsigned initial_station = 1;  // 5.1.2

plc::com_mode mode_of(line_protocol p)
{
    switch (p) {
    case line_protocol::mewtocol_com: return plc::com_mode::mewtocol_com;
    case line_protocol::mewtocol7_com: return plc::com_mode::mewtocol7_com;
    case line_protocol::general_purpose: return plc::com_mode::general_purpose;
    default: return plc::com_mode::modbus_rtu;
    }
}

// A line cannot tell RS-422 from RS-232C.
plc::com_card card_of(const line_config& line)
{
    return line.rs485.enabled ? plc::com_card::rs485 : plc::com_card::rs232c;
}

}  // namespace

plc::com_parameters com_parameters_of(const line_config& line, unsigned station)
{
    plc::com_parameters of{
        .mode = mode_of(line.protocol), .station = station, .format = format_of(line), .send_wait = line.gap};
    if (line.protocol == line_protocol::general_purpose) {  // the codes of both are those of PMGET
        of.send_wait = line.messages.send_wait;
        of.start = static_cast<plc::start_code>(line.messages.start);
        of.end = static_cast<plc::end_code>(line.messages.end);
        of.end_silence = line.messages.end_silence;
    }
    return of;
}

plc::com_parameters com_parameters_of(const plc_link_station& station)
{
    return {.mode = plc::com_mode::plc_link,
            .station = station.station,
            .format = {.baud_rate = 115'200, .data_bits = 8, .check = parity::odd, .stop_bits = 1},
            .link = station.settings};
}

fp7_ports::fp7_ports(asio::io_context& loop, std::function<void()> settle) : settle_(std::move(settle)), timer_(loop) {}

fp7_unit* fp7_ports::open(plc::simulated_plc& plc, unsigned com, const line_config& line, unsigned station,
                          std::function<void()> reset)
{
    if (&plc.model() != &plc::fp7)
        return nullptr;
    const auto [at, is_new] = units_.try_emplace(&plc, unit_at_work{fp7_unit(plc), {}});
    at->second.unit.open(now(), com, com_parameters_of(line, station), card_of(line));
    at->second.resets[com] = std::move(reset);
    return &at->second.unit;
}

void fp7_ports::open(plc::simulated_plc& plc, unsigned com, const line_config& line, line_driver& driver)
{
    fp7_unit* const unit = open(plc, com, line, initial_station, [&driver] { driver.reset_channel(); });
    if (fp7_line_ports* const ports = driver.com_ports())
        ports->add(unit, com);
}

bool fp7_ports::open(plc::simulated_plc& plc, const plc_link_station& station, std::function<void()> reset)
{
    const auto [at, is_new] = units_.try_emplace(&plc, unit_at_work{fp7_unit(plc), {}});
    if (!at->second.resets.try_emplace(link_port, std::move(reset)).second)
        return false;
    at->second.unit.open(now(), link_port, com_parameters_of(station), plc::com_card::rs485);
    return true;
}

void fp7_ports::look()
{
    for (auto& [plc, each] : units_) {
        for (const unsigned com : each.unit.run(now())) {
            each.resets.at(com)();
            each.unit.reset_done(now(), com);
        }
    }
    wait();
}

// What stands for a scan ends without anybody writing to the memory.
void fp7_ports::wait()
{
    std::optional<time_point> first;
    for (const auto& [plc, each] : units_)
        if (const auto due = each.unit.deadline(); due && (!first || *due < *first))
            first = due;
    if (first == waits_for_)
        return;
    waits_for_ = first;
    timer_.cancel();
    if (!first)
        return;
    timer_.expires_at(*first);
    timer_.async_wait([this](boost::system::error_code ec) {
        if (ec)
            return;
        waits_for_.reset();
        settle_();
    });
}

}  // namespace plcgw
