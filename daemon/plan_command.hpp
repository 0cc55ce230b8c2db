// `plc-gateway plan`: the requests by which the stations of a configuration are read; and what `plc-gateway check` says
// about the bus time that this takes.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/learned_store.hpp"

#include <filesystem>

namespace plcgw {

// Exit status: 0, or 1 when the configuration has mistakes or no such line. An empty name: all lines.
int show_plan(const std::filesystem::path& config_file, const std::string& line);

struct line_load {
    std::string line;
    double needed = 0;              // of the line's time: 1 is all of it
    std::vector<std::string> rows;  // for people, one for each read route
    std::string overload;           // "line1 needs 137 %: these periods are reachable: ..."; empty: none
};

// Of the lines that poll stations.
std::vector<line_load> loads_of(const gateway_config& config, const learned_by_station& learned);

// What the file in the state folder holds; what is wrong with it goes to stderr.
learned_by_station learned_for(const gateway_config& config);

}  // namespace plcgw
