#include "bridge/dds/log.hpp"

#include "bridge/dds/log_capture.hpp"
#include "bridge/dds/log_limiter.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <mutex>

namespace plcgw {
namespace {

using namespace std::chrono_literals;

// Several of Cyclone's threads may log at once.
struct log_state {
    std::mutex mutex;
    dds_log_handler handler;
    log_limiter limiter{10, 60s};
};

log_state& state()
{
    static log_state instance;
    return instance;
}

thread_local log_capture* capture = nullptr;

void deliver(dds_log_level level, const std::string& line)
{
    auto& s = state();
    const std::scoped_lock lock(s.mutex);
    if (!s.handler)
        return;
    const auto now = std::chrono::time_point_cast<duration>(std::chrono::steady_clock::now());
    const auto suppressed = s.limiter.admit(now);
    if (!suppressed)
        return;
    if (*suppressed > 0)
        s.handler(dds_log_level::warning, fmt::format("{} more suppressed", *suppressed));
    s.handler(level, line);
}

dds_log_level level_of(std::uint32_t priority)
{
    if (priority & (DDS_LC_FATAL | DDS_LC_ERROR))
        return dds_log_level::error;
    return priority & DDS_LC_WARNING ? dds_log_level::warning : dds_log_level::info;
}

void on_log(void*, const dds_log_data_t* data)
{
    std::string line(data->message, data->size);
    line.erase(line.find_last_not_of(" \r\n") + 1);
    if (capture)
        capture->add(level_of(data->priority), std::move(line));
    else
        deliver(level_of(data->priority), line);
}

}  // namespace

void set_dds_log(dds_log_handler handler)
{
    auto& s = state();
    const std::scoped_lock lock(s.mutex);
    s.handler = std::move(handler);
}

log_capture::log_capture()
{
    state();  // outlives Cyclone's threads
    dds_set_log_sink(on_log, nullptr);
    capture = this;
}

log_capture::~log_capture()
{
    capture = nullptr;
    for (const auto& [level, line] : lines_)
        deliver(level, line);
}

std::string log_capture::text()
{
    std::string joined;
    for (const auto& [level, line] : std::exchange(lines_, {}))
        joined += (joined.empty() ? "" : "; ") + line;
    return joined;
}

}  // namespace plcgw
