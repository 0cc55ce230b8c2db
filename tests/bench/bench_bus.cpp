// Emulates an RS-485 pair that several members share, each by a pty of its own, with MODBUS RTU stations on it.
// usage: bench-bus PLAN.json LOG COMMANDS     the plan: see README.md; LOG gets a line of JSON for each request on the
// wire, each collision, each register that a station wrote and each command; COMMANDS is a FIFO that is made: "cut K"
// pulls the cable of member K, "join K" plugs it in. SIGTERM ends it.
#include "tests/bench/described.hpp"
#include "tests/bench/party_line.hpp"
#include "tests/bench/urgent.hpp"
#include "tests/field/pty.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <poll.h>
#include <sstream>
#include <sys/stat.h>

namespace plcgw::bench {
namespace {

using nlohmann::json;

// poll() cannot wait until somebody opens an unused port, so those are looked at this often.
constexpr nanoseconds unused_port_interval = 10'000'000;

class bus {
public:
    bus(const json& plan, const std::string& log, const std::string& commands)
        : line_(line_of(plan)), log_(log, std::ios::app)
    {
        for (const json& each : plan.at("members"))
            members_.emplace_back(each.get<std::string>());
        if (::mkfifo(commands.c_str(), 0600) == -1 && errno != EEXIST)
            field::check(-1, commands);
        // Also for writing, so that it does not end when a writer leaves.
        commands_ = field::unique_fd(field::check(::open(commands.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC), commands));
    }

    void run()
    {
        const field::unique_fd signals = field::signals_as_descriptor({SIGTERM, SIGINT});
        while (field::next_signal(signals) == 0) {
            wait(signals);
            hand_over();
            listen();
            obey();
            tell();
        }
    }

private:
    static party_line line_of(const json& plan)
    {
        const wire_format format{plan.at("baud"), plan.value("bits", 11U), delivery::byte};
        return {format, stations_of(plan.at("stations"), format), plan.at("members").size()};
    }

    void wait(const field::unique_fd& signals)
    {
        std::vector<pollfd> watched{{.fd = signals.get(), .events = POLLIN, .revents = 0},
                                    {.fd = commands_.get(), .events = POLLIN, .revents = 0}};
        nanoseconds longest = 1'000'000'000;
        for (const field::pty& each : members_) {
            if (each.in_use())
                watched.push_back({.fd = each.fd(), .events = POLLIN, .revents = 0});
            else
                longest = unused_port_interval;
        }
        const nanoseconds left = std::clamp<nanoseconds>(line_.deadline() - now(), 0, longest);
        const timespec timeout{.tv_sec = left / 1'000'000'000, .tv_nsec = left % 1'000'000'000};
        ::ppoll(watched.data(), watched.size(), &timeout, nullptr);
    }

    void hand_over()
    {
        std::vector<byte_vector> chunks(members_.size());
        for (const auto& each : line_.due(now()))
            chunks[each.by].push_back(each.byte);
        for (std::size_t i = 0; i < chunks.size(); ++i)
            if (!chunks[i].empty())
                members_[i].send(chunks[i]);
    }

    void listen()
    {
        std::array<std::uint8_t, 1024> room{};
        for (std::size_t i = 0; i < members_.size(); ++i)
            if (members_[i].look())
                line_.heard(now(), i, members_[i].receive(room));
    }

    void obey()
    {
        std::array<char, 256> room{};
        const auto size = ::read(commands_.get(), room.data(), room.size());
        std::istringstream words(std::string(room.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))));
        std::string what;
        std::size_t member = 0;
        while (words >> what >> member) {
            const bool known = member < members_.size() && (what == "cut" || what == "join");
            if (known)
                line_.cut(member, what == "cut");
            say({{"event", known ? what : "unknown"}, {"at", now()}, {"member", member}});
        }
    }

    void tell()
    {
        using kind = party_line::event::kind;
        for (const auto& each : line_.take_events()) {
            json said{{"at", each.at}, {"talker", each.talker}};
            if (each.what == kind::collision) {
                said.update({{"event", "collision"}, {"other", each.other}});
            }
            else {
                said.update({{"event", each.what == kind::write ? "write" : "request"},
                             {"unit", each.unit},
                             {"function", each.function},
                             {"first", each.first},
                             {"value", each.value}});
            }
            if (each.what == kind::request)
                said.update({{"damaged", each.damaged}, {"too_short", each.silence < line_.format().rule()}});
            say(said);
        }
    }

    void say(const json& event) { log_ << event.dump() << std::endl; }

    party_line line_;
    std::deque<field::pty> members_;
    field::unique_fd commands_;
    std::ofstream log_;
};

}  // namespace
}  // namespace plcgw::bench

int main(int argc, char** argv)
try {
    if (argc != 4) {
        std::cerr << "usage: bench-bus PLAN.json LOG COMMANDS\n";
        return 2;
    }
    std::ifstream plan(argv[1]);
    plcgw::bench::bus line(nlohmann::json::parse(plan), argv[2], argv[3]);
    plcgw::bench::become_urgent();
    std::cout << "bench-bus: ready" << std::endl;
    line.run();
}
catch (const std::exception& error) {
    std::cerr << "bench-bus: " << error.what() << '\n';
    return 1;
}
