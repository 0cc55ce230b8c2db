#include "daemon/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>

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

}  // namespace

void start(log_level least)
{
    std::shared_ptr<spdlog::logger> logger;
    if (std::getenv("JOURNAL_STREAM") != nullptr) {  // systemd.exec(5): our stderr is the journal
        logger = std::make_shared<spdlog::logger>("plc-gateway", std::make_shared<spdlog::sinks::systemd_sink_mt>());
    }
    else {
        logger = std::make_shared<spdlog::logger>("plc-gateway",
                                                  std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%-7l%$ %v");
    }
    logger->set_level(spdlog_level(least));
    logger->flush_on(spdlog::level::debug);
    spdlog::set_default_logger(std::move(logger));
}

void write(log_level level, std::string_view text) { spdlog::log(spdlog_level(level), "{}", text); }

}  // namespace plcgw::log
