// The command line.
#include "daemon/access_arguments.hpp"
#include "daemon/config/schema.hpp"
#include "daemon/dds_arguments.hpp"
#include "daemon/link_time_command.hpp"
#include "daemon/map_command.hpp"
#include "daemon/pair_command.hpp"
#include "daemon/plan_command.hpp"
#include "daemon/plc_command.hpp"
#include "daemon/plc_link_command.hpp"
#include "daemon/run.hpp"
#include "daemon/scan_cli.hpp"
#include "daemon/version.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <iostream>

namespace {

constexpr int usage_error = 2;
constexpr int cannot_run = 3;  // for example out of memory or descriptors: systemd tries again

void add_map(CLI::App& command, plcgw::map_options& o)
{
    CLI::Option* const config = command.add_option("-c,--config", o.config_file, "Configuration file");
    config->capture_default_str();
    CLI::Option* const plc = command.add_option("-p,--plc", o.plc, "Name of the PLC; none: all of the configuration");
    command.add_option("-m,--model", o.model, "The default map of this model, without a configuration")
        ->excludes(config)
        ->excludes(plc);
    command.add_option("queries", o.queries,
                       "Devices (D8015, X17), numbers (hr:0, coil:0x1E00, ir:, di:) or references "
                       "(40001, 400001); none: the whole map");
}

void add_link_time(CLI::App& command, plcgw::link_time_options& o)
{
    const CLI::Range milliseconds(0.0, 32767.0);
    const CLI::Range bytes(1, 513);
    command.add_option("--baud", o.baud_rate, "Bits per second")->check(CLI::PositiveNumber)->capture_default_str();
    command.add_option("--bits", o.bits, "Data bits, parity, stop bits")->capture_default_str();
    command.add_option("--framing", o.framing, "Frame mode")
        ->check(CLI::IsMember({"rtu", "ascii"}))
        ->capture_default_str();
    command.add_option("--function", o.function, "Function code, 16 or 0x10")->capture_default_str();
    command.add_option("--count", o.count, "Items read or written")->capture_default_str();
    command.add_option("--write-count", o.write_count, "Registers that function 0x17 writes")->capture_default_str();
    command.add_option("--delay", o.delay_ms, "Message to message delay D8411, ms")
        ->check(milliseconds)
        ->capture_default_str();
    command.add_option("--scan", o.scan_ms, "Longest scan time, ms")->check(milliseconds)->capture_default_str();
    command.add_option("--slave-delay,--server-delay", o.server_delay_ms, "Until the server answers, ms")
        ->check(milliseconds)
        ->capture_default_str();
    command.add_option("--request", o.request_bytes, "Bytes of the request, instead of function and count")
        ->check(bytes);
    command.add_option("--response", o.response_bytes, "Bytes of the response, likewise")->check(bytes);
    command.add_option("--plc-link", o.link_stations, "A round of a PLC link of so many FP PLCs, 2 to 16, instead");
    command.add_option("--absent", o.absent, "Stations of the PLC link that are off")->capture_default_str();
    command.add_option("--relay-words", o.relay_words, "Words of link relays that each sends; default: an equal share");
    command.add_option("--register-words", o.register_words, "Link registers that each sends, likewise");
}

int run_command(int argc, char** argv)
{
    CLI::App app{"Serial devices as the memory of a simulated PLC, for MODBUS TCP and DDS", "plc-gateway"};
    app.set_version_flag("--version", std::string("plc-gateway ") + plcgw::version);
    app.require_subcommand(1);

    std::string config_file = "/etc/plc-gateway/plc-gateway.json";
    CLI::App* const run = app.add_subcommand("run", "Run the gateway in the foreground");
    run->add_option("-c,--config,config", config_file, "Configuration file")->capture_default_str();

    std::string checked_file;
    CLI::App* const check = app.add_subcommand("check", "Report every mistake in a configuration file");
    check->add_option("file", checked_file, "Configuration file")->required();
    std::string overload = "error";
    check->add_option("--overload", overload, "What a line is that needs more than its time")
        ->check(CLI::IsMember({"error", "warn"}))
        ->capture_default_str();

    std::string planned_file;
    std::string planned_line;
    CLI::App* const plan = app.add_subcommand("plan", "Show by which requests the stations are read, and why");
    plan->add_option("file", planned_file, "Configuration file")->required();
    plan->add_option("line", planned_line, "Name of a line; none: all");

    plcgw::watch_arguments watched;
    CLI::App* const watch =
        app.add_subcommand("watch", "Show what gateways publish: registers, points, states, events");
    watched.add_to(*watch);

    plcgw::doctor_arguments examined;
    CLI::App* const doctor = app.add_subcommand("doctor", "Look for what is wrong, and say what to do");
    doctor->require_subcommand(1);
    CLI::App* const doctor_dds = doctor->add_subcommand("dds", "Why gateways and readers do not find each other");
    examined.add_to(*doctor_dds);

    plcgw::map_options mapped;
    CLI::App* const map = app.add_subcommand("map", "Show which device stands behind which MODBUS number");
    add_map(*map, mapped);

    plcgw::link_time_options timed;
    CLI::App* const link_time = app.add_subcommand("linktime", "How long one question takes between two PLCs");
    add_link_time(*link_time, timed);

    std::string plc_action = "list";
    std::string plc_name;
    std::string socket;
    CLI::App* const plc = app.add_subcommand("plc", "Show the simulated PLCs of the running gateway, or switch one");
    plc->add_option("action", plc_action, "list, run, stop or power-cycle")->capture_default_str();
    plc->add_option("name", plc_name, "Name of the PLC");
    plc->add_option("--socket", socket, "Control socket of the gateway; default: where it usually is");

    CLI::App* const plc_link = app.add_subcommand("plc-link", "Show the PLC links of the running gateway");
    plc_link->add_option("--socket", socket, "Control socket of the gateway; default: where it usually is");

    plcgw::scan_options scanned;
    CLI::App* const scan = app.add_subcommand("scan", "Look for stations on a line");
    plcgw::add_scan(*scan, scanned);
    std::string pair_action = "show";
    CLI::App* const pair = app.add_subcommand("pair", "Show both members of a hot-standby pair, or change their roles");
    pair->add_option("action", pair_action, "show or switch")->capture_default_str();
    pair->add_option("--socket", socket, "Control socket of the gateway; default: where it usually is");
    plcgw::access_arguments access;
    access.add_to(app);

    const CLI::App* const schema = app.add_subcommand("schema", "Print the JSON Schema of the configuration");

    try {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& wrong) {
        return app.exit(wrong) == 0 ? 0 : usage_error;
    }
    if (*run)
        return plcgw::run(config_file);
    if (*check)
        return plcgw::check(checked_file, overload == "warn");
    if (*plan)
        return plcgw::show_plan(planned_file, planned_line);
    if (*watch)
        return watched.run();
    if (*doctor_dds)
        return examined.run();
    if (*plc)
        return plcgw::plc_client(socket, plc_action, plc_name);
    if (*plc_link)
        return plcgw::plc_link_client(socket);
    if (*scan)
        return plcgw::scan_stations(scanned);
    if (*pair)
        return plcgw::pair_client(socket, pair_action);
    if (*map)
        return plcgw::show_map(mapped);
    if (*link_time)
        return plcgw::show_link_time(timed);
    if (const auto status = access.run())
        return *status;
    if (*schema)
        std::cout << plcgw::config::schema();
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run_command(argc, argv);
    }
    catch (const std::exception& broken) {
        std::fprintf(stderr, "plc-gateway: %s\n", broken.what());
        return cannot_run;
    }
}
