// The communication units of the FP7s, and the lines that stand for their COM ports: status devices are kept up to
// date, and a channel reset reaches the line. FP7 manual 4.1, 10.3, 10.4.
#pragma once

#include "bridge/services/fp7_unit.hpp"
#include "daemon/config/config.hpp"
#include "daemon/line_driver.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <functional>

namespace plcgw {

namespace asio = boost::asio;

class fp7_ports {
public:
    // settle: called when the time changed devices, to drain that. It calls look().
    fp7_ports(asio::io_context& loop, std::function<void()> settle);

    // The line stands for this port. reset: the line gives up what it does; it has done so when the call returns.
    // Nothing happens for a PLC that is no FP7, and null is returned; else what the line tells its port.
    fp7_unit* open(plc::simulated_plc& plc, unsigned com, const line_config& line, unsigned station,
                   std::function<void()> reset);

    // A general-purpose line, or a client line on which the PLC is thought to ask.
    void open(plc::simulated_plc& plc, unsigned com, const line_config& line, line_driver& driver);

    // A PLC link: COM.1 of the CPU, which may be in that mode (6.2.1). False, and nothing happens, when a line or
    // another link stands for that port already: a second link is one of a unit in a slot, which PMGET reads elsewhere.
    bool open(plc::simulated_plc& plc, const plc_link_station& station, std::function<void()> reset);

    // To be called after the memory changed and before the changes are drained.
    void look();

private:
    struct unit_at_work {
        fp7_unit unit;
        std::map<unsigned, std::function<void()>> resets;  // by COM number
    };

    void wait();

    std::function<void()> settle_;
    std::map<plc::simulated_plc*, unit_at_work> units_;
    asio::steady_timer timer_;
    std::optional<time_point> waits_for_;
};

// As the line's settings show in PMGET.
plc::com_parameters com_parameters_of(const line_config& line, unsigned station);

// Those of a PLC link, of which the CPU sets all but the station and the areas (6.2.3).
plc::com_parameters com_parameters_of(const plc_link_station& station);

}  // namespace plcgw
