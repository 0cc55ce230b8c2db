#include "daemon/run.hpp"

#include "daemon/gateway.hpp"
#include "daemon/log.hpp"
#include "daemon/plan_command.hpp"
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

// What the lines need of their time; how many need more than all of it goes to stderr.
std::size_t say_loads(const std::filesystem::path& config_file, const gateway_config& config, bool as_warning)
{
    std::size_t overloads = 0;
    for (const line_load& each : loads_of(config, learned_for(config))) {
        fmt::print("{}: {:.1f} ms/s, {:.1f} %\n", each.line, 1000 * each.needed, 100 * each.needed);
        for (const std::string& row : each.rows)
            fmt::print("{}\n", row);
        if (each.overload.empty())
            continue;
        fmt::print(stderr, "{}: {}{}\n", config_file.string(), as_warning ? "warning: " : "", each.overload);
        ++overloads;
    }
    return overloads;
}

}  // namespace

int check(const std::filesystem::path& config_file, bool overload_is_a_warning)
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
    return say_loads(config_file, c, overload_is_a_warning) == 0 || overload_is_a_warning ? 0 : 1;
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
    // It is no reason to stand still: the periods grow, and the routes say so.
    for (const line_load& each : loads_of(loaded.config, learned_for(loaded.config)))
        if (!each.overload.empty())
            log::warning("{}", each.overload);
    gateway running(loop, loaded);
    log::info("plc-gateway {} started with {}", version, config_file.string());
    if (!running.start())
        return cannot_listen;
    loop.run();
    running.leave();
    return 0;
}

}  // namespace plcgw
