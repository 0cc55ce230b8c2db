// An FP7 with MEWTOCOL-COM on its serial port, which controls a press. tests/field/README.md lists its devices.
#include "tests/field/fp7_station.hpp"
#include "tests/field/press.hpp"
#include "tests/field/pty.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <iostream>
#include <optional>
#include <poll.h>

namespace plcgw::field {
namespace {

constexpr int interval_ms = 10;  // poll() cannot wait until somebody opens an unused port, and the press moves

struct options {
    std::string link;
    unsigned station = 1;
    bool still = false;
    bool no_expansion = false;
    bool trace = false;
    std::vector<std::string> assignments;
};

std::string without_cr(const std::string& frame) { return frame.substr(0, frame.find('\r')); }

class simulation {
public:
    explicit simulation(const options& o)
        : line_(o.link), collector_(!o.no_expansion), station_(o.station, memory_), trace_(o.trace)
    {
        if (!o.still)
            press_.emplace(memory_);
        for (const std::string& each : o.assignments)
            memory_.assign(each);
    }

    void run(const unique_fd& signals);

private:
    void listen(double now);

    fp7_memory memory_;
    std::optional<press> press_;
    pty line_;
    frame_collector collector_;
    fp7_station station_;
    bool trace_;
};

void simulation::run(const unique_fd& signals)
{
    using clock = std::chrono::steady_clock;
    const auto began = clock::now();
    double moved = 0;
    for (;;) {
        pollfd waiting[] = {{.fd = signals.get(), .events = POLLIN, .revents = 0},
                            {.fd = line_.fd(), .events = POLLIN, .revents = 0}};
        if (::poll(waiting, line_.in_use() ? 2 : 1, interval_ms) > 0 && next_signal(signals) != 0)
            return;
        const double now = std::chrono::duration<double>(clock::now() - began).count();
        if (press_)
            press_->advance(now - std::exchange(moved, now));
        if (line_.look())
            listen(now);
    }
}

void simulation::listen(double now)
{
    std::array<std::uint8_t, 4096> room{};
    for (const std::uint8_t byte : line_.receive(room)) {
        const auto frame = collector_.take(static_cast<char>(byte), now);
        if (!frame)
            continue;
        const std::string answer = station_.hear(*frame);
        line_.send({reinterpret_cast<const std::uint8_t*>(answer.data()), answer.size()});
        if (trace_)
            std::cout << frame->text << " -> " << without_cr(answer) << std::endl;
    }
}

}  // namespace
}  // namespace plcgw::field

int main(int argc, char** argv)
try {
    using namespace plcgw::field;

    CLI::App app{"Simulated FP7 that answers MEWTOCOL-COM and controls a press."};
    options o;
    app.add_option("--link", o.link, "where the gateway finds its serial port")->required();
    app.add_option("--station", o.station, "its number")->check(CLI::Range(1, 99))->capture_default_str();
    app.add_option("--set", o.assignments,
                   "DEVICE=VALUE[,VALUE...]: what its memory holds, such as DT0=5,6 WR1=0x8001 R1F=1");
    app.add_flag("--still", o.still, "no press: the memory changes only when somebody writes");
    app.add_flag("--no-expansion", o.no_expansion, "knows the header % only, as older stations");
    app.add_flag("--trace", o.trace, "print each frame with its answer");
    CLI11_PARSE(app, argc, argv);

    const unique_fd signals = signals_as_descriptor({SIGTERM, SIGINT});
    simulation simulated(o);
    std::cout << "field-fp7: station " << o.station << " on " << o.link << std::endl;
    simulated.run(signals);
}
catch (const std::exception& error) {
    std::cerr << "field-fp7: " << error.what() << '\n';
    return 1;
}
