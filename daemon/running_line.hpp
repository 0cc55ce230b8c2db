// A client line at work: its routes, what carries its requests, and the way in for others who ask its stations.
#pragma once

#include "bridge/routes/plc_copies.hpp"
#include "bridge/routes/route_status.hpp"
#include "daemon/config/config.hpp"
#include "daemon/forward_gate.hpp"
#include "daemon/learned_store.hpp"
#include "daemon/line_driver.hpp"

#include <boost/asio/io_context.hpp>

#include <functional>
#include <memory>

namespace plcgw {

using find_plc = std::function<plc::simulated_plc&(const std::string& name)>;

class running_line {
public:
    // The stations and routes of this line are taken from the configuration, which has no mistakes. settle: called
    // after each exchange, to drain what it changed.
    running_line(boost::asio::io_context& loop, const gateway_config& all, const line_config& line, const find_plc& plc,
                 std::function<void()> settle);

    // What its stations have taught: from the time before, and now.
    void remember(const learned_by_station& all);
    void tell(learned_by_station& all) const;

    const line_config config;
    client_line routes;
    status_board statuses{routes};  // of these, as words of the PLCs
    const std::unique_ptr<line_driver> driver;
    forward_gate gate;

private:
    std::vector<unsigned> units_;  // of its stations
};

route make_route(const route_config& from, const find_plc& plc);  // of a station

plc_copy make_copy(const route_config& from, const find_plc& plc);  // of a PLC

// One value for all registers or bits of a route, or one for each, packed as its words.
std::vector<std::uint16_t> packed_values(const route& of, const std::vector<unsigned>& values);

// How a line is spoken to: of a station, or of any unit that is none.
modbus::serial_options timing_of(const line_config& line);
modbus::serial_options timing_of(const line_config& line, const station_config& station);

}  // namespace plcgw
