// A wire and the pty at which the client finds it as its serial port.
#pragma once

#include "tests/bench/pty.hpp"
#include "tests/bench/stillness.hpp"
#include "tests/bench/wire.hpp"

#include <filesystem>

namespace plcgw::bench {

class wire_port {
public:
    wire_port(std::filesystem::path link, wire on);
    ~wire_port();
    wire_port(const wire_port&) = delete;
    wire_port& operator=(const wire_port&) = delete;

    int fd() const { return pty_.ours.get(); }
    void hand_over(nanoseconds now, stillness& machine);  // what is due
    void listen(nanoseconds now);                         // to what the client sent
    nanoseconds deadline() const { return wire_.deadline(); }
    nlohmann::json report();
    void begin() { wire_.window().begin(); }

private:
    std::filesystem::path link_;
    wire wire_;
    pty_pair pty_;
};

}  // namespace plcgw::bench
