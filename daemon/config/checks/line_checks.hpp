// Parts of the check of a line.
#pragma once

#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

// Of each COM port of an FP7: the line that stands for it.
using com_port_users = std::map<std::pair<std::string, unsigned>, std::string>;

void check_server_line(check_context& c, com_port_users& com_ports, std::size_t i, const line_config& l);
void check_mewtocol(check_context& c, std::size_t i, const line_config& l);

}  // namespace plcgw::config
