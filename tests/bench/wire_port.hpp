// A wire, and where its client finds it: a pty as serial port, or a TCP port as behind a device server.
#pragma once

#include "tests/bench/pty.hpp"
#include "tests/bench/stillness.hpp"
#include "tests/bench/wire.hpp"

#include <filesystem>

namespace plcgw::bench {

class wire_port {
public:
    wire_port(const std::filesystem::path& link, wire on);
    wire_port(std::uint16_t port, wire on);  // of 127.0.0.1; for one client at a time
    ~wire_port();
    wire_port(const wire_port&) = delete;
    wire_port& operator=(const wire_port&) = delete;

    int fd() const { return fd_.get(); }
    void hand_over(nanoseconds now, stillness& machine);  // what is due
    // Something is to be read, or a client connected or left. True when fd() is another one now.
    bool look(nanoseconds now);
    nanoseconds deadline() const { return wire_.deadline(); }
    nlohmann::json report();
    void begin() { wire_.window().begin(); }

private:
    void wait_for_client();

    std::filesystem::path link_;  // empty: TCP
    wire wire_;
    field::unique_fd fd_;
    field::unique_fd theirs_;  // of a pty
    std::uint16_t port_ = 0;
    bool accepts_ = false;  // fd_ waits for a client
};

}  // namespace plcgw::bench
