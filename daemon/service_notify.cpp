#include "daemon/service_notify.hpp"

#include <systemd/sd-daemon.h>

#include <cstdint>

namespace plcgw::service {

void ready() { sd_notify(0, "READY=1"); }
void status(const std::string& text) { sd_notify(0, ("STATUS=" + text).c_str()); }
void stopping() { sd_notify(0, "STOPPING=1"); }
void feed_watchdog() { sd_notify(0, "WATCHDOG=1"); }

std::optional<std::chrono::microseconds> watchdog_period()
{
    std::uint64_t microseconds = 0;
    if (sd_watchdog_enabled(0, &microseconds) <= 0)
        return std::nullopt;
    return std::chrono::microseconds(microseconds / 2);
}

}  // namespace plcgw::service
