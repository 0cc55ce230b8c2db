// Parts of the check of a line.
#pragma once

#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {

void check_server_line(check_context& c, std::size_t i, const line_config& l);
void check_mewtocol(check_context& c, std::size_t i, const line_config& l);

}  // namespace plcgw::config
