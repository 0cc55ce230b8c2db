// `plc-gateway map`: a PLC's MODBUS map, whole or asked for one device or number.
#pragma once

#include <string>
#include <vector>

namespace plcgw {

struct map_options {
    std::string config_file = "/etc/plc-gateway/plc-gateway.json";
    std::string plc;                   // of the configuration; empty: all of them
    std::string model;                 // not empty: this model's default map, without a configuration
    std::vector<std::string> queries;  // none: the whole map
};

// Exit status: 0, or 1 when a question cannot be answered or the configuration is wrong.
int show_map(const map_options& options);

}  // namespace plcgw
