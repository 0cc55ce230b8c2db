// `plc-gateway watch`: shows what gateways publish over DDS, as a table, as lines, or as JSON for scripts.
#pragma once

#include "bridge/dds/settings.hpp"
#include "daemon/watch_filter.hpp"

#include <chrono>
#include <optional>

namespace plcgw {

struct watch_options {
    dds_settings dds;
    bool json = false;                                 // one object per line for each event
    std::optional<unsigned> count;                     // end after so many samples, is_counted()
    std::optional<std::chrono::milliseconds> timeout;  // end after this time
    watch_filter filter;
};

// Runs until count, timeout, Ctrl-C (SIGINT, SIGTERM, SIGHUP) or the end of who reads its output. On a terminal it
// shows a table. Exit code: 0; or 1 if DDS could not be set up, fewer than count samples came, or none until the
// timeout.
int watch(const watch_options& options);

}  // namespace plcgw
