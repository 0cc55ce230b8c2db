// A scan on a port of its own: for each combination of protocol, baud rate and format a line without routes.
#include "daemon/config/read.hpp"
#include "daemon/log.hpp"
#include "daemon/read_before.hpp"
#include "daemon/run.hpp"
#include "daemon/scan/scan_client.hpp"
#include "daemon/scan/scan_combinations.hpp"
#include "daemon/scan/scan_json.hpp"
#include "daemon/scan/scan_report.hpp"
#include "daemon/serial_port.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/signal_set.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr milliseconds serial_timeout{100};
constexpr milliseconds network_timeout{500};
constexpr milliseconds look_every{50};
constexpr duration most_absence = std::chrono::seconds(7);  // a connection takes 5 s to fail

std::string title_of(const line_config& line)
{
    if (line.protocol == line_protocol::modbus_tcp)
        return line.host;
    return fmt::format("{} {} {}", name_of(line.protocol), line.baud_rate,
                       to_string(scan_format{line.data_bits, line.check, line.stop_bits}));
}

// One combination on a loop of its own.
class lone_scan {
public:
    lone_scan(const line_config& line, std::vector<unsigned> units, milliseconds timeout, scan_progress& progress)
        : config_(line), units_(std::move(units)), timeout_(timeout), progress_(progress), timer_(loop_),
          signals_(loop_, SIGINT, SIGTERM), line_(loop_, only(line), line, no_plc, [] {})
    {
    }

    // The status as of scan_alone(); found() is there in any case.
    int run()
    {
        signals_.async_wait([this](boost::system::error_code cancelled, int) {
            if (!cancelled)
                end(scan_interrupted);
        });
        begin_scan(line_, units_, timeout_, now());
        absent_since_ = now();
        asio::co_spawn(loop_, line_.driver->run(), asio::detached);
        asio::co_spawn(loop_, watch(), asio::detached);
        loop_.run();
        return status_;
    }

    json found() { return scan_json(line_, now()); }

private:
    static gateway_config only(const line_config& line)
    {
        gateway_config made;
        made.lines = {line};
        return made;
    }
    static plc::simulated_plc& no_plc(const std::string&) { throw std::logic_error("a scan has no routes"); }

    void end(int status)
    {
        status_ = status;
        line_.routes.end_scan();
        loop_.stop();
    }

    asio::awaitable<void> watch()
    {
        for (;;) {
            timer_.expires_after(look_every);
            co_await timer_.async_wait(no_throw);
            const json scan = found();
            progress_.show(scan, what_);
            if (scan["state"] == "done")
                end(0);
            if (line_.routes.is_port_open())
                absent_since_ = now();
            else if (now() - absent_since_ > most_absence)
                end(scan_failure(scan_refused, fmt::format("{} went away, or cannot be reached",
                                                           config_.device.empty() ? config_.host : config_.device)));
        }
    }

    const line_config config_;
    std::vector<unsigned> units_;
    milliseconds timeout_;
    scan_progress& progress_;
    const std::string what_ = title_of(config_);
    time_point absent_since_{};
    int status_ = 0;
    asio::io_context loop_{1};
    asio::steady_timer timer_;
    asio::signal_set signals_;
    running_line line_;
};

// Empty when the port can be opened now.
std::string port_trouble(const line_config& line)
{
    if (line.device.empty())
        return {};
    std::string ignored;
    const auto fd = open_serial_port(line, ignored);
    if (fd) {
        ::close(*fd);
        return {};
    }
    const boost::system::error_code& why = fd.error();
    const bool is_used = why == boost::system::errc::device_or_resource_busy ||
                         why == boost::system::errc::resource_unavailable_try_again ||
                         why == boost::system::errc::operation_would_block;
    if (is_used)
        return fmt::format("{} is in use. If the gateway runs on it, let that scan: plc-gateway scan LINE. Or stop it "
                           "first; `fuser -v {}` shows who uses the port",
                           line.device, line.device);
    return fmt::format("{} cannot be opened: {}", line.device, why.message());
}

struct base_line {
    line_config line;
    std::vector<station_config> stations;  // known from the configuration
    int status = 0;
};

base_line base_of(const scan_options& o)
{
    base_line made;
    made.line.name = "line1";
    made.line.device = o.device;
    made.line.host = o.host;
    made.line.port = o.port;
    if (!o.host.empty())
        made.line.protocol = line_protocol::modbus_tcp;
    if (o.config_file.empty())
        return made;
    const auto loaded = config::load_file(o.config_file);
    if (config::has_errors(loaded.found)) {
        made.status = check(o.config_file);  // says what is wrong with it
        return made;
    }
    std::string names;
    for (const line_config& each : loaded.config.lines) {
        const bool asks = each.role == line_role::client && each.protocol != line_protocol::general_purpose;
        if (asks)
            names.append(names.empty() ? "" : ", ").append(each.name);
        if (!asks || each.name != o.line)
            continue;
        made.line = each;
        for (const station_config& station : loaded.config.stations)
            if (station.line == o.line)
                made.stations.push_back(station);
        return made;
    }
    made.status = scan_failure(scan_refused, fmt::format("{} has no line \"{}\" on which the gateway asks, but: {}",
                                                         o.config_file, o.line, names));
    return made;
}

void add_names(json& scan, const std::vector<station_config>& stations)
{
    for (json& each : scan["stations"])
        for (const station_config& station : stations)
            if (each.value("unit", 0U) == station.unit)
                each["name"] = station.name;
}

}  // namespace

int scan_alone(const scan_options& o, json& scans)
{
    log::start(log_level::error);
    const base_line base = base_of(o);
    if (base.status != 0)
        return base.status;
    const scan_combinations tried = combinations_of(o, base.line);
    if (tried.status != 0)
        return tried.status;
    std::signal(SIGPIPE, SIG_IGN);
    scan_progress progress;
    int status = 0;
    for (const line_config& line : tried.lines) {
        std::optional<std::vector<unsigned>> units{std::in_place};
        if (!o.units.empty())
            units = parse_numbers(o.units, lowest_unit(line.protocol), highest_unit(line.protocol));
        if (!units)
            return scan_failure(scan_misused,
                                fmt::format("--units {}: give numbers and ranges from {} to {}, as 1-32,40", o.units,
                                            lowest_unit(line.protocol), highest_unit(line.protocol)));
        if (const std::string trouble = port_trouble(line); !trouble.empty())
            return scan_failure(scan_refused, trouble);
        const milliseconds derived = line.device.empty() ? network_timeout : serial_timeout;
        lone_scan scan(line, *units, o.timeout_ms != 0 ? milliseconds(o.timeout_ms) : derived, progress);
        status = scan.run();
        json found = scan.found();
        add_names(found, base.stations);
        scans.push_back(std::move(found));
        if (status != 0 || (stations_in(scans) != 0 && !o.all))
            break;
    }
    progress.end();
    return status;
}

}  // namespace plcgw
