// A client line at work: its routes, what carries its requests, and the way in for others who ask its stations.
#pragma once

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
    const std::unique_ptr<line_driver> driver;
    forward_gate gate;

private:
    std::vector<unsigned> units_;  // of its stations
};

// How a line is spoken to: of a station, or of any unit that is none.
modbus::serial_options timing_of(const line_config& line);
modbus::serial_options timing_of(const line_config& line, const station_config& station);

}  // namespace plcgw
