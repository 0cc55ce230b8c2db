// A weighing scale with a serial port, as its maker would describe it: nobody asks, it sends its display twice a second
// as ST,GS,+00123.4kg (stable) or US,GS,+00123.4kg (in motion), CR and LF. A hopper on it is filled and emptied.
#include "tests/field/pty.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <poll.h>

namespace plcgw::field {
namespace {

constexpr double full_kg = 240.0;
constexpr double fill_s = 30.0;  // from empty to full
constexpr double rest_s = 10.0;  // at either end

struct display {
    double kg;
    bool stable;
};

display at(double seconds)
{
    const double in_turn = std::fmod(seconds, 2 * (fill_s + rest_s));
    const double half = std::fmod(in_turn, fill_s + rest_s);
    const double filled = std::min(half / fill_s, 1.0) * full_kg;
    return {in_turn < fill_s + rest_s ? filled : full_kg - filled, half >= fill_s};
}

std::string message(const display& shown)
{
    std::array<char, 32> text{};
    const int size =
        std::snprintf(text.data(), text.size(), "%s,GS,%+08.1fkg\r\n", shown.stable ? "ST" : "US", shown.kg);
    return {text.data(), static_cast<std::size_t>(size)};
}

void run(pty& line, const unique_fd& signals, int period_ms)
{
    std::array<std::uint8_t, 256> room{};
    for (double seconds = 0;; seconds += period_ms / 1000.0) {
        while (line.look() && !line.receive(room).empty()) {  // it does not listen
        }
        const std::string text = message(at(seconds));
        line.send({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        pollfd waiting{.fd = signals.get(), .events = POLLIN, .revents = 0};
        if (::poll(&waiting, 1, period_ms) > 0 && next_signal(signals) != 0)
            return;
    }
}

}  // namespace
}  // namespace plcgw::field

int main(int argc, char** argv)
try {
    using namespace plcgw::field;

    CLI::App app{"Simulated scale that sends its weight by itself."};
    std::string link;
    int period_ms = 500;
    app.add_option("--link", link, "where the gateway finds its serial port")->required();
    app.add_option("--period-ms", period_ms, "milliseconds from one message to the next")->check(CLI::Range(1, 60'000));
    CLI11_PARSE(app, argc, argv);

    const unique_fd signals = signals_as_descriptor({SIGTERM, SIGINT});
    pty line(link);
    std::cout << "field-scale: on " << link << std::endl;
    run(line, signals, period_ms);
}
catch (const std::exception& error) {
    std::cerr << "field-scale: " << error.what() << '\n';
    return 1;
}
