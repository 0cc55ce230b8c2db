// The command line.
#include "daemon/config/read.hpp"
#include "daemon/config/schema.hpp"
#include "daemon/run.hpp"
#include "daemon/version.hpp"
#include "daemon/watch.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <iostream>

namespace {

constexpr int usage_error = 2;
constexpr int cannot_run = 3;  // for example out of memory or descriptors: systemd tries again

// The options of `watch`, from the command line or from the configuration of the gateway that is watched.
struct watch_arguments {
    plcgw::watch_options options;
    std::string config_file;
    unsigned timeout_s = 0;
    unsigned count = 0;

    void add_to(CLI::App& command)
    {
        command.add_option("-c,--config", config_file, "Take the DDS settings from this configuration");
        command.add_option("-d,--domain", options.dds.domain, "DDS domain")->capture_default_str();
        command.add_option("-i,--interface", options.dds.interface, "Network interface; empty: the first suitable")
            ->capture_default_str();
        command.add_option("--peer", options.dds.peers, "Address of a host that multicast does not reach");
        command.add_option("--partition", options.dds.partition, "DDS partition");
        command.add_flag("--json", options.json, "One JSON object per line");
        command.add_option("-n,--count", count, "End after so many register samples");
        command.add_option("-t,--timeout", timeout_s, "End after so many seconds");
        command.add_option("routes", options.filters, "Beginnings of route names; none: all");
    }

    int run()
    {
        if (!config_file.empty()) {
            const auto loaded = plcgw::config::load_file(config_file);
            if (plcgw::config::has_errors(loaded.found))
                return plcgw::check(config_file);  // says what is wrong with it
            options.dds = loaded.config.dds.settings;
        }
        if (count != 0)
            options.count = count;
        if (timeout_s != 0)
            options.timeout = std::chrono::seconds(timeout_s);
        return plcgw::watch(options);
    }
};

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

    watch_arguments watched;
    CLI::App* const watch = app.add_subcommand("watch", "Show live registers, received by DDS");
    watched.add_to(*watch);

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
        return plcgw::check(checked_file);
    if (*watch)
        return watched.run();
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
