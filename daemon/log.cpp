#include "daemon/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace plcgw::log {
namespace {

spdlog::level::level_enum spdlog_level(log_level level)
{
    switch (level) {
    case log_level::debug: return spdlog::level::debug;
    case log_level::info: return spdlog::level::info;
    case log_level::warning: return spdlog::level::warn;
    case log_level::error: return spdlog::level::err;
    }
    return spdlog::level::info;
}

// systemd.exec(5): JOURNAL_STREAM names the device and inode of the journal's socket. It is inherited by shells too, so
// only a stderr that is that socket means that systemd started us.
bool stderr_is_journal()
{
    const char* const stream = std::getenv("JOURNAL_STREAM");
    struct stat opened {};
    return stream != nullptr && ::fstat(STDERR_FILENO, &opened) == 0 &&
           stream == fmt::format("{}:{}", opened.st_dev, opened.st_ino);
}

}  // namespace

void start(log_level least)
{
    std::shared_ptr<spdlog::logger> logger;
    if (stderr_is_journal()) {
        logger = std::make_shared<spdlog::logger>("plc-gateway", std::make_shared<spdlog::sinks::systemd_sink_mt>());
    }
    else {
        logger =
            std::make_shared<spdlog::logger>("plc-gateway", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%-7l%$ %v");
    }
    logger->set_level(spdlog_level(least));
    logger->flush_on(spdlog::level::debug);
    spdlog::set_default_logger(std::move(logger));
}

void write(log_level level, std::string_view text) { spdlog::log(spdlog_level(level), "{}", text); }

}  // namespace plcgw::log
