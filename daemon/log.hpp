// The daemon's log: journald when systemd started us, the console otherwise. spdlog stays behind this header.
#pragma once

#include "daemon/config/config.hpp"

#include <fmt/core.h>

#include <string_view>
#include <utility>

namespace plcgw::log {

void start(log_level least);
void write(log_level level, std::string_view text);

template <class... Args>
void debug(fmt::format_string<Args...> format, Args&&... args)
{
    write(log_level::debug, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args)
{
    write(log_level::info, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warning(fmt::format_string<Args...> format, Args&&... args)
{
    write(log_level::warning, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void error(fmt::format_string<Args...> format, Args&&... args)
{
    write(log_level::error, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace plcgw::log
