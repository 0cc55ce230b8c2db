// The far end of the DDS benchmarks, and a bare Cyclone writer to compare with: the gateway's types, QoS and settings.
// usage: bench-dds xml                                Cyclone's configuration, for ddsperf
//        bench-dds read DOMAIN PARTITION REPORTS      counts what it takes, and notes every block
//        bench-dds write DOMAIN PARTITION REPORTS block|point INSTANCES BURST PERIOD_US      0: as fast as it can
// REPORTS gets a line of JSON at each SIGUSR1, which also begins a new window. SIGTERM ends it.
#include "tests/bench/bench_dds_reader.hpp"
#include "tests/bench/bench_dds_writer.hpp"

#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>

using namespace plcgw;
using namespace plcgw::bench;

namespace {

// Threads that are made later must not get these signals.
sigset_t block_signals()
{
    sigset_t set;
    sigemptyset(&set);
    for (const int each : {SIGUSR1, SIGTERM})
        sigaddset(&set, each);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    return set;
}

void report_until_terminated(const sigset_t& signals, const std::string& file,
                             const std::function<nlohmann::json()>& report)
{
    std::ofstream reports(file, std::ios::app);
    std::cout << "ready" << std::endl;
    for (int signal = 0; sigwait(&signals, &signal) == 0 && signal != SIGTERM;)
        reports << report().dump() << std::endl;
}

int run(const std::vector<std::string>& args)
{
    const bool reads = args.size() == 4 && args[0] == "read";
    const bool writes = args.size() == 8 && args[0] == "write" && (args[4] == "block" || args[4] == "point");
    if (args == std::vector<std::string>{"xml"}) {
        std::cout << cyclone_xml({}) << '\n';
        return 0;
    }
    if (!reads && !writes) {
        std::cerr << "usage: see the head of bench_dds.cpp\n";
        return 2;
    }
    const sigset_t signals = block_signals();
    dds_settings settings;
    settings.domain = static_cast<std::uint32_t>(std::stoul(args[1]));
    settings.partition = args[2];
    if (reads) {
        reader from(settings);
        report_until_terminated(signals, args[3], [&] { return from.report(); });
        return 0;
    }
    const load wanted{args[4] == "block", static_cast<unsigned>(std::stoul(args[5])),
                      static_cast<unsigned>(std::stoul(args[6])), std::chrono::microseconds(std::stol(args[7]))};
    writer to(settings, wanted);
    report_until_terminated(signals, args[3], [&] { return to.report(); });
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run({argv + 1, argv + argc});
    }
    catch (const std::exception& error) {
        std::cerr << "bench-dds: " << error.what() << '\n';
        return 1;
    }
}
