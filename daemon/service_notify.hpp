// What systemd wants to hear from a Type=notify service (sd_notify(3)). Without systemd nothing happens.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace plcgw::service {

void ready();
void status(const std::string& text);  // shown by systemctl status
void stopping();
void feed_watchdog();

// How often feed_watchdog() has to be called, if at all: half of what the unit allows.
std::optional<std::chrono::microseconds> watchdog_period();

}  // namespace plcgw::service
