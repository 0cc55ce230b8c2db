// Emulates serial wires with MODBUS RTU stations: paces bytes as UARTs do, and measures what is on the wires.
// usage: bench-wire PLAN.json REPORTS     the plan: see README.md; REPORTS gets a line of JSON at each SIGUSR1, which
// also begins a new window, and at the end (SIGTERM)
#include "tests/bench/described.hpp"
#include "tests/bench/pty_probe.hpp"
#include "tests/bench/urgent.hpp"
#include "tests/bench/wire_port.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iostream>
#include <memory>
#include <sys/epoll.h>

namespace plcgw::bench {
namespace {

using nlohmann::json;
using wire_ports = std::vector<std::unique_ptr<wire_port>>;

wire wire_of(const json& described)
{
    wire_format format{described.at("baud"), described.value("bits", 11U), delivery::byte};
    const std::string how = described.value("delivery", "byte");
    format.how = how == "fifo" ? delivery::fifo : how == "frame" ? delivery::frame : delivery::byte;
    return {format, stations_of(described.at("stations"), format)};
}

void write_report(const wire_ports& ports, const stillness& machine, bool urgent, std::ofstream& to)
{
    json report{{"machine", machine.report(now())}, {"urgent", urgent}, {"lines", json::array()}};
    for (const auto& each : ports)
        report["lines"].push_back(each->report());
    to << report.dump() << std::endl;
}

void begin_window(const wire_ports& ports, stillness& machine)
{
    machine.begin(now());
    for (const auto& each : ports)
        each->begin();
}

// Waits until a client sent something, a signal came, or something is due.
int wait(const field::unique_fd& poller, std::span<epoll_event> events, const wire_ports& ports, nanoseconds earliest)
{
    for (const auto& each : ports)
        earliest = std::min(earliest, each->deadline());
    const nanoseconds left = std::clamp<nanoseconds>(earliest - now(), 0, 1'000'000'000);
    const timespec timeout{.tv_sec = left / 1'000'000'000, .tv_nsec = left % 1'000'000'000};
    return ::epoll_pwait2(poller.get(), events.data(), static_cast<int>(events.size()), &timeout, nullptr);
}

void watch(const field::unique_fd& poller, int fd, void* what)
{
    epoll_event event{.events = EPOLLIN, .data = {.ptr = what}};
    field::check(::epoll_ctl(poller.get(), EPOLL_CTL_ADD, fd, &event), "epoll_ctl");
}

void run(const json& plan, std::ofstream& reports)
{
    wire_ports ports;
    for (const json& each : plan.at("lines")) {
        if (each.contains("port"))
            ports.push_back(std::make_unique<wire_port>(each["port"].get<std::uint16_t>(), wire_of(each)));
        else
            ports.push_back(std::make_unique<wire_port>(each.at("link").get<std::string>(), wire_of(each)));
    }

    const field::unique_fd signals = field::signals_as_descriptor({SIGTERM, SIGINT, SIGUSR1});
    const field::unique_fd poller(field::check(::epoll_create1(EPOLL_CLOEXEC), "epoll_create1"));
    watch(poller, signals.get(), nullptr);
    for (const auto& each : ports)
        watch(poller, each->fd(), each.get());
    pty_probe probe;
    watch(poller, probe.fd(), &probe);
    const bool urgent = become_urgent();
    stillness machine;
    begin_window(ports, machine);
    std::cout << "bench-wire: " << ports.size() << " lines" << std::endl;

    std::array<epoll_event, 64> events{};
    for (;;) {
        const int count = wait(poller, events, ports, probe.deadline());
        for (const auto& each : ports)
            each->hand_over(now(), machine);
        probe.send(now());
        for (int i = 0; i < count; ++i) {
            void* const what = events[static_cast<std::size_t>(i)].data.ptr;
            if (what == &probe) {
                machine.note_hop(probe.received(now()));
                continue;
            }
            if (what != nullptr) {
                auto& port = *static_cast<wire_port*>(what);
                if (port.look(now()))
                    watch(poller, port.fd(), &port);
                continue;
            }
            const int signal = field::next_signal(signals);
            write_report(ports, machine, urgent, reports);
            if (signal != SIGUSR1)
                return;
            begin_window(ports, machine);
        }
    }
}

}  // namespace
}  // namespace plcgw::bench

int main(int argc, char** argv)
try {
    std::signal(SIGPIPE, SIG_IGN);  // a client that left is no end
    if (argc != 3) {
        std::cerr << "usage: bench-wire PLAN.json REPORTS\n";
        return 2;
    }
    std::ifstream plan(argv[1]);
    std::ofstream reports(argv[2], std::ios::app);
    plcgw::bench::run(nlohmann::json::parse(plan), reports);
}
catch (const std::exception& error) {
    std::cerr << "bench-wire: " << error.what() << '\n';
    return 1;
}
