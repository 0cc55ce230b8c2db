// One simulated device: a unit on a serial line, and the same registers through a TCP side door.
#include "tests/field/line_server.hpp"
#include "tests/field/profile.hpp"
#include "tests/field/registers.hpp"
#include "tests/field/side_door.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <iostream>
#include <optional>

namespace plcgw::field {
namespace {

struct device_config {
    std::string port;
    int unit = 1;
    int baud_rate = 19200;
    std::string profile = "plain";
    int tcp_port = 0;  // 0: no side door
    std::vector<std::string> set;
    bool silent = false;
};

class device {
public:
    explicit device(const device_config& config);
    void serve(const unique_fd& signals);  // until a signal comes; throws if the line goes away

private:
    void answer_line();
    modbus_mapping_t& live_registers();

    device_config config_;
    modbus_registers registers_ = make_registers();
    std::uint32_t answers_ = 0;
    profile profile_;
    std::chrono::steady_clock::time_point updated_ = std::chrono::steady_clock::now();
    line_server line_;
    std::optional<side_door> door_;
};

device::device(const device_config& config) : config_(config), line_(config.port, config.baud_rate, config.unit)
{
    profile_ = start_profile(config.profile, *registers_);
    for (const std::string& assignment : config.set)
        set_register(*registers_, assignment);
    if (config.tcp_port != 0)
        door_.emplace(config.tcp_port);
}

void device::serve(const unique_fd& signals)
{
    for (;;) {
        std::vector<pollfd> watched{{.fd = signals.get(), .events = POLLIN, .revents = 0},
                                    {.fd = line_.fd(), .events = POLLIN, .revents = 0}};
        if (door_)
            door_->watch(watched);
        if (::poll(watched.data(), watched.size(), -1) == -1 && errno != EINTR)
            check(-1, "poll");

        if (watched[0].revents != 0)
            return;
        if ((watched[1].revents & (POLLHUP | POLLERR)) != 0)
            throw std::runtime_error(config_.port + " hung up");
        if (watched[1].revents != 0)
            answer_line();
        if (door_)
            door_->serve(std::span(watched).subspan(2), [this]() -> modbus_mapping_t& { return live_registers(); });
    }
}

void device::answer_line()
{
    const request received = line_.receive();
    if (received.empty())
        return;
    if (config_.silent)
        line_.serve_without_reply(received, live_registers());
    else if (line_.reply(received, live_registers()))
        set_long(&registers_->tab_input_registers[answers_address], ++answers_);
}

modbus_mapping_t& device::live_registers()
{
    const auto now = std::chrono::steady_clock::now();
    profile_(*registers_, std::chrono::duration<double>(now - updated_).count());
    updated_ = now;
    return *registers_;
}

}  // namespace
}  // namespace plcgw::field

int main(int argc, char** argv)
try {
    using namespace plcgw::field;

    CLI::App app{"Simulated MODBUS RTU device, with libmodbus as its server."};
    device_config config;
    app.add_option("--port", config.port, "serial port")->required();
    app.add_option("--unit", config.unit, "unit id")->required()->check(CLI::Range(1, 247));
    app.add_option("--baud", config.baud_rate, "baud rate, 8N1");
    app.add_option("--profile", config.profile, "what moves")->check(CLI::IsMember(profile_names()));
    app.add_option("--tcp", config.tcp_port, "side door on 127.0.0.1")->check(CLI::Range(1, 65535));
    app.add_option("--set", config.set, "first values: hr:0=1234 co:3=1 (also ir, di)");
    app.add_flag("--silent", config.silent, "carry requests out, but never answer on the line");
    CLI11_PARSE(app, argc, argv);

    const unique_fd signals = signals_as_descriptor({SIGTERM, SIGINT});
    device simulated(config);
    std::cout << "field-device: unit " << config.unit << " on " << config.port << std::endl;
    simulated.serve(signals);
}
catch (const std::exception& error) {
    std::cerr << "field-device: " << error.what() << '\n';
    return 1;
}
