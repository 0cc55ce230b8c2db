// A line on which we answer, made from the configuration: its stations, what carries them, and the channels and ports
// of the PLCs that it stands for.
#pragma once

#include "daemon/fp7_ports.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/running_line.hpp"

namespace plcgw {

// What a PLC shows of a line that the configuration sets up.
plc::channel_line shown_line(const line_config& line, plc::role as, unsigned unit);

using find_gate = std::function<forward_gate&(const std::string& line)>;

// settle: called after each exchange, to drain what it changed.
std::unique_ptr<line_driver> make_server_line(asio::io_context& loop, const line_config& line, const find_plc& plc,
                                              const find_gate& gate, fp7_ports& ports, std::function<void()> settle);

}  // namespace plcgw
