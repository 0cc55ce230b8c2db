// The line itself: one pty for the gateway, one for each device, and the bytes between them.
//
// It behaves like four-wire RS-485: devices hear the gateway, the gateway hears the devices, and the devices do not
// hear each other. On two wires libmodbus's RTU server would have to tell the answers of the others from requests: it
// takes whatever follows a request to another unit for that unit's answer, so a dead unit costs its neighbours a
// request.
#include "tests/field/pty.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <csignal>
#include <deque>
#include <iostream>
#include <optional>
#include <poll.h>
#include <vector>

namespace plcgw::field {
namespace {

// poll() cannot wait until somebody opens an unused port, so those are looked at this often.
constexpr int unused_port_interval_ms = 10;

class bus {
public:
    bus(std::string link, const std::string& port_prefix, unsigned first_port, unsigned ports) : link_(std::move(link))
    {
        plug_in();
        for (unsigned i = 0; i < ports; ++i)
            devices_.emplace_back(port_prefix + std::to_string(first_port + i));
    }

    void plug_in()
    {
        if (!gateway_)
            gateway_.emplace(link_);
    }
    void pull_out() { gateway_.reset(); }

    void wait(const unique_fd& signals) const;
    void forward();

private:
    std::string link_;
    std::optional<pty> gateway_;  // empty: the cable is pulled
    std::deque<pty> devices_;
};

void bus::wait(const unique_fd& signals) const
{
    std::vector<pollfd> watched{{.fd = signals.get(), .events = POLLIN, .revents = 0}};
    int timeout = -1;
    const auto watch = [&](const pty& port) {
        if (port.in_use())
            watched.push_back({.fd = port.fd(), .events = POLLIN, .revents = 0});
        else
            timeout = unused_port_interval_ms;
    };
    if (gateway_)
        watch(*gateway_);
    for (const pty& device : devices_)
        watch(device);
    ::poll(watched.data(), watched.size(), timeout);
}

void bus::forward()
{
    std::array<std::uint8_t, 4096> room;
    const bool request = gateway_ && gateway_->look();
    for (pty& device : devices_) {
        // Taken even if nobody listens: the answer to a pulled cable must not wait for the next one.
        if (device.look() && gateway_)
            gateway_->send(device.receive(room));
        else
            device.receive(room);
    }
    if (request) {
        const auto bytes = gateway_->receive(room);
        for (pty& device : devices_)
            device.send(bytes);
    }
}

void run(bus& line, const unique_fd& signals)
{
    for (;;) {
        line.wait(signals);
        switch (next_signal(signals)) {
        case SIGUSR1: line.pull_out(); break;
        case SIGUSR2: line.plug_in(); break;
        case SIGTERM:
        case SIGINT: return;
        default: line.forward();
        }
    }
}

}  // namespace
}  // namespace plcgw::field

int main(int argc, char** argv)
try {
    using namespace plcgw::field;

    CLI::App app{"Simulated serial line. SIGUSR1 pulls the gateway's cable out, SIGUSR2 plugs it in."};
    std::string link, prefix;
    unsigned ports = 1;
    app.add_option("--link", link, "where the gateway finds its serial port")->required();
    app.add_option("--ports", ports, "number of device ports: LINK.1 to LINK.N");
    app.add_option("--port-links", prefix, "name the device ports PREFIX0, PREFIX1, ... instead");
    CLI11_PARSE(app, argc, argv);

    const unique_fd signals = signals_as_descriptor({SIGTERM, SIGINT, SIGUSR1, SIGUSR2});
    bus line = prefix.empty() ? bus(link, link + ".", 1, ports) : bus(link, prefix, 0, ports);
    std::cout << "field-bus: " << ports << " ports on " << link << std::endl;
    run(line, signals);
}
catch (const std::exception& error) {
    std::cerr << "field-bus: " << error.what() << '\n';
    return 1;
}
