#include "daemon/scan/scan_client.hpp"

#include "daemon/control_client.hpp"
#include "daemon/read_before.hpp"
#include "daemon/scan/scan_report.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr int nobody = 4;
constexpr auto look_every = milliseconds(200);

volatile std::sig_atomic_t interrupted = 0;

void print(std::FILE* to, const std::string& text) { fmt::print(to, "{}", text); }

bool write_stub(const scan_options& o, const json& scans)
{
    if (o.output.empty())
        return true;
    const std::string stub = scan_stub(scans);
    if (o.output == "-") {
        print(stdout, stub);
        return true;
    }
    std::ofstream file(o.output);
    file << stub;
    file.close();
    if (file)
        return true;
    scan_failure(scan_refused, fmt::format("{} cannot be written", o.output));
    return false;
}

int report(const scan_options& o, const json& scans, int status)
{
    const auto hints = scan_hints(scans);
    if (o.json) {
        print(o.output == "-" ? stderr : stdout, json{{"scans", scans}, {"hints", hints}}.dump() + "\n");
    }
    else {
        std::FILE* const to = o.output == "-" ? stderr : stdout;
        print(to, scan_table(scans));
        for (const std::string& each : hints)
            print(to, each + "\n");
    }
    if (!write_stub(o, scans))
        return scan_refused;
    return status != 0 ? status : stations_in(scans) == 0 ? nobody : 0;
}

json ask(const scan_options& o, const std::string& action, json with = json::object())
{
    with.update({{"command", "scan"}, {"action", action}, {"line", o.line}});
    return ask_gateway(o.socket, with);
}

int refused_by(const json& reply)
{
    return scan_failure(scan_refused, reply.value("error", "the gateway did not understand"));
}

}  // namespace

int scan_failure(int status, const std::string& why)
{
    fmt::print(stderr, "plc-gateway: {}\n", why);
    return status;
}

void scan_progress::show(const json& scan, const std::string& what)
{
    constexpr long long every_s = 5;
    const bool is_terminal = ::isatty(STDERR_FILENO) == 1;
    const std::string text =
        fmt::format("{}: {} of {} units asked, {} answered", what, scan.value("units_asked", std::size_t{0}),
                    scan.value("units_total", std::size_t{0}), stations_in(json::array({scan})));
    const long long second = now().time_since_epoch() / std::chrono::seconds(1);
    if (text == shown_ || (!is_terminal && shown_at_s_ >= 0 && second - shown_at_s_ < every_s))
        return;
    fmt::print(stderr, "{}{}{}", is_terminal ? "\r\033[K" : "", text, is_terminal ? "" : "\n");
    std::fflush(stderr);
    shown_ = text;
    shown_at_s_ = second;
}

void scan_progress::end()
{
    if (!shown_.empty() && ::isatty(STDERR_FILENO) == 1)
        fmt::print(stderr, "\n");
}

int scan_through_gateway(const scan_options& o, json& scans)
{
    if (!o.bauds.empty() || !o.formats.empty() || !o.protocols.empty() || o.all)
        return scan_failure(
            scan_misused, fmt::format("the running gateway's line {} keeps its protocol, baud rate and format: others "
                                      "would disturb its stations. Stop the gateway, or take the line out of its "
                                      "configuration, and scan the port itself: plc-gateway scan -c FILE {} --bauds "
                                      "...",
                                      o.line, o.line));
    json start = json::object();
    if (!o.units.empty()) {
        const auto units = parse_numbers(o.units, 0, highest_unit(line_protocol::mewtocol7_com));
        if (!units)
            return scan_failure(scan_misused, fmt::format("--units {}: give numbers and ranges, as 1-32,40", o.units));
        start["units"] = *units;
    }
    if (o.timeout_ms != 0)
        start["timeout_ms"] = o.timeout_ms;
    const auto note = [](int) { interrupted = 1; };
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    json reply = ask(o, "start", start);
    scan_progress progress;
    while (reply.value("ok", false) && reply.value("state", "") == "running" && interrupted == 0) {
        progress.show(reply, reply.value("port_open", false) ? o.line : o.line + " (its port is absent)");
        std::this_thread::sleep_for(look_every);
        reply = ask(o, "status");
    }
    if (interrupted != 0)
        reply = ask(o, "stop");
    progress.end();
    if (!reply.value("ok", false))
        return refused_by(reply);
    reply.erase("ok");
    scans.push_back(reply);
    return interrupted != 0 ? scan_interrupted : 0;
}

int scan_stations(const scan_options& o)
{
    const bool has_port = !o.device.empty() || !o.host.empty();
    if (o.line.empty() && !has_port)
        return scan_failure(scan_misused, "name a line, or give --device or --host");
    if (has_port && (!o.line.empty() || !o.config_file.empty() || (!o.device.empty() && !o.host.empty())))
        return scan_failure(scan_misused, "give one of: a line, --device, --host");
    json scans = json::array();
    const int status = has_port || !o.config_file.empty() ? scan_alone(o, scans) : scan_through_gateway(o, scans);
    return status == 0 || (status == scan_interrupted && !scans.empty()) ? report(o, scans, status) : status;
}

}  // namespace plcgw
