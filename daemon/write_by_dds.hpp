// `plc-gateway write --dds` and `send --dds`: asks any gateway of the DDS domain, from any host.
#pragma once

#include "bridge/dds/settings.hpp"
#include "daemon/write_client.hpp"

namespace plcgw {

struct dds_access_options {
    dds_settings dds;
    std::string gateway = "gateway";
    std::string client{};       // who asks; empty: a name that nobody else has
    std::uint64_t request = 1;  // the gateway executes each number of a client once
    unsigned wait_ms = 8000;    // for the reply; the request is repeated until then
};

// A point by its name, or registers of a route: pump.set/holding:100, press.set/DT:100.
int write_by_dds(const access_options& o, const dds_access_options& how);
int send_by_dds(const access_options& o, const dds_access_options& how);

}  // namespace plcgw
