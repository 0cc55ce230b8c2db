#include "daemon/dds_arguments.hpp"

#include "daemon/config/read.hpp"
#include "daemon/doctor/doctor.hpp"
#include "daemon/run.hpp"
#include "daemon/watch_device.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace plcgw {
namespace {

constexpr int usage_error = 2;

}  // namespace

void site_arguments::add_to(CLI::App& command)
{
    command.add_option("-c,--config", config_file_, "Take the DDS settings from this configuration");
    command.add_option("-d,--domain", dds.domain, "DDS domain")->check(CLI::Range(0, 230))->capture_default_str();
    command.add_option("-i,--interface", dds.interface, "Network interface; empty: the first suitable")
        ->capture_default_str();
    command.add_option("--peer", dds.peers, "Address of a host that multicast does not reach");
    command.add_option("--partition", partitions_, "DDS partition; plant* for all whose names begin so")
        ->allow_extra_args(false);
}

std::optional<int> site_arguments::load()
{
    if (!config_file_.empty()) {
        auto loaded = config::load_file(config_file_);
        if (config::has_errors(loaded.found))
            return check(config_file_);  // says what is wrong with it
        dds = loaded.config.dds.settings;
        config = std::move(loaded.config);
    }
    if (!partitions_.empty()) {
        dds.partition.clear();
        dds.partitions = partitions_;
    }
    return std::nullopt;
}

void watch_arguments::add_to(CLI::App& command)
{
    site_.add_to(command);
    command.add_flag("--json", options_.json, "One JSON object per line");
    command.add_option("-g,--gateway", options_.filter.gateways, "Only these gateways")->allow_extra_args(false);
    command
        .add_option("--topic", topics_,
                    "Only these: RegisterBlock, Point, PortStatus, DeviceStatus, GatewayStatus, Event, SerialMessage")
        ->allow_extra_args(false);
    command.add_option(
        "--device", device_,
        "Only blocks over this device of a PLC, D100 or main.D100; with --config points and routes, too");
    command.add_option("-n,--count", count_, "End after so many samples of registers and points, or of the topics");
    command.add_option("-t,--timeout", timeout_s_, "End after so many seconds");
    command.add_option("names", options_.filter.names,
                       "Beginnings of names: of routes, points, lines, ports, devices; none: all");
}

int watch_arguments::run()
{
    if (const auto failed = site_.load())
        return *failed;
    options_.dds = site_.dds;
    for (const std::string& each : topics_) {
        const auto topic = topic_from(each);
        if (!topic)
            return fmt::print(stderr, "--topic: there is no topic {}: see --help\n", each), usage_error;
        options_.filter.topics.push_back(*topic);
    }
    if (!device_.empty()) {
        const std::string wrong = filter_by_device(device_, site_.config, options_.filter);
        if (!wrong.empty())
            return fmt::print(stderr, "--device: {}\n", wrong), usage_error;
    }
    if (count_ != 0)
        options_.count = count_;
    if (timeout_s_ != 0)
        options_.timeout = std::chrono::seconds(timeout_s_);
    return watch(options_);
}

void doctor_arguments::add_to(CLI::App& command)
{
    site_.add_to(command);
    command.add_option("-w,--wait", seconds_, "Seconds to listen for others")
        ->check(CLI::Range(1, 60))
        ->capture_default_str();
}

int doctor_arguments::run()
{
    if (const auto failed = site_.load())
        return *failed;
    return doctor_dds(site_.dds, seconds_);
}

}  // namespace plcgw
