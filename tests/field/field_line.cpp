// A whole line for the demo: the bus and its devices, each in a process of its own, so that a test can kill one.
#include "tests/field/posix.hpp"
#include "tests/field/simulated_line.hpp"

#include <CLI/CLI.hpp>

#include <csignal>
#include <iostream>
#include <poll.h>

namespace plcgw::field {
namespace {

void run(simulated_line& line, const unique_fd& signals)
{
    for (;;) {
        pollfd waiting{.fd = signals.get(), .events = POLLIN, .revents = 0};
        ::poll(&waiting, 1, -1);
        switch (const int signal = next_signal(signals)) {
        case SIGTERM:
        case SIGINT: return;
        case SIGCHLD: line.report_ended(); break;
        case SIGUSR1:
        case SIGUSR2: line.signal_bus(signal); break;
        default: break;
        }
    }
}

}  // namespace
}  // namespace plcgw::field

int main(int argc, char** argv)
try {
    using namespace plcgw::field;

    CLI::App app{"Simulated line with its devices. SIGUSR1 pulls the gateway's cable out, SIGUSR2 plugs it in."};
    std::string link, pid_dir;
    std::vector<std::string> devices;
    app.add_option("--link", link, "where the gateway finds its serial port; device k is on LINK.k")->required();
    app.add_option("--device", devices, "UNIT[:PROFILE[:TCPPORT]], several times")->required();
    app.add_option("--pid-dir", pid_dir, "write UNIT.pid and bus.pid there");
    CLI11_PARSE(app, argc, argv);

    const unique_fd signals = signals_as_descriptor({SIGTERM, SIGINT, SIGCHLD, SIGUSR1, SIGUSR2});
    simulated_line line(link, pid_dir);
    line.start(devices);
    std::cout << "field-line: " << devices.size() << " devices on " << link << std::endl;
    run(line, signals);
}
catch (const std::exception& error) {
    std::cerr << "field-line: " << error.what() << '\n';
    return 1;
}
