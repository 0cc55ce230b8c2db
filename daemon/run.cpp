#include "daemon/run.hpp"

#include "daemon/gateway.hpp"
#include "daemon/log.hpp"
#include "daemon/service_notify.hpp"
#include "daemon/version.hpp"

#include <boost/asio/signal_set.hpp>

#include <csignal>
#include <cstdio>

namespace plcgw {
namespace {

constexpr int cannot_listen = 3;

void print(const std::filesystem::path& file, const config::mistakes& found)
{
    for (const config::mistake& each : found)
        fmt::print(stderr, "{}\n", config::to_string(file.string(), each));
}

void log_all(const std::filesystem::path& file, const config::mistakes& found)
{
    for (const config::mistake& each : found)
        log::write(each.how == config::mistake::weight::error ? log_level::error : log_level::warning,
                   config::to_string(file.string(), each));
}

std::string counted(std::size_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

void wait_for_signal(asio::signal_set& signals, asio::io_context& loop)
{
    signals.async_wait([&](boost::system::error_code cancelled, int signal) {
        if (cancelled)
            return;
        if (signal == SIGHUP) {
            log::warning("SIGHUP: this version cannot reload its configuration, restart it");
            wait_for_signal(signals, loop);
            return;
        }
        log::info("{} ends the gateway", signal == SIGTERM ? "SIGTERM" : "SIGINT");
        service::stopping();
        loop.stop();
    });
}

}  // namespace

int check(const std::filesystem::path& config_file)
{
    const config::loaded loaded = config::load_file(config_file);
    print(config_file, loaded.found);
    if (config::has_errors(loaded.found)) {
        fmt::print(stderr, "{}: {}\n", config_file.string(), counted(config::count_errors(loaded.found), "mistake"));
        return 1;
    }
    const gateway_config& c = loaded.config;
    fmt::print("{} is correct: {}, {}, {}, {}, {}\n", config_file.string(), counted(c.plcs.size(), "PLC"),
               counted(c.lines.size(), "line"), counted(c.stations.size(), "station"),
               counted(c.routes.size(), "route"), counted(c.modbus_tcp.size(), "MODBUS TCP server"));
    return 0;
}

int run(const std::filesystem::path& config_file)
{
    const config::loaded loaded = config::load_file(config_file);
    log::start(loaded.config.log.level);
    log_all(config_file, loaded.found);
    if (config::has_errors(loaded.found))
        return 1;

    std::signal(SIGPIPE, SIG_IGN);  // a client that vanished is an error code, not a death
    asio::io_context loop(1);
    asio::signal_set signals(loop, SIGTERM, SIGINT, SIGHUP);
    wait_for_signal(signals, loop);
    gateway running(loop, loaded);
    log::info("plc-gateway {} started with {}", version, config_file.string());
    if (!running.start())
        return cannot_listen;
    loop.run();
    return 0;
}

}  // namespace plcgw
