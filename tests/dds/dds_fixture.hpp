// What the DDS tests share: a domain of their own, waiting on a subscriber, and a second process.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "bridge/dds/subscriber.hpp"

#include <chrono>
#include <fcntl.h>
#include <functional>
#include <poll.h>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace plcgw::test {

using namespace std::chrono_literals;
using steady = std::chrono::steady_clock;

constexpr auto deadline = 20s;  // generous: a loaded machine with sanitizers; what arrives is waited for no longer

// Tests that run at the same time must not meet. Domains up to 100 have UDP ports below the ephemeral ones.
inline dds_settings own_domain()
{
    dds_settings settings;
    settings.domain = 1 + static_cast<std::uint32_t>(::getpid()) % 100;
    settings.partition = "test-" + std::to_string(::getpid());
    return settings;
}

// The same for dds_peer.
inline std::string place()
{
    const auto own = own_domain();
    return std::to_string(own.domain) + "/" + own.partition;
}

inline dds_identity identity(std::string gateway) { return {std::move(gateway), "member-1", "0.1.0", "abc123"}; }

inline sample block(unsigned route, std::uint16_t value, quality state = quality::good)
{
    return {"route-" + std::to_string(route),
            "holding",
            route * 10,
            sample_format::words,
            2,
            {value, 42},
            state,
            wall_time{1'700'000'000'000'000'000 + value}};
}

// Takes until done returns true. False if the deadline passed.
inline bool collect(dds_subscriber& in, std::vector<dds_event>& events,
                    const std::function<bool(const std::vector<dds_event>&)>& done)
{
    const auto end = steady::now() + deadline;
    while (!done(events)) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady::now()).count();
        ::pollfd ready{in.descriptor(), POLLIN, 0};
        if (left <= 0 || ::poll(&ready, 1, static_cast<int>(left)) <= 0)
            return false;
        for (auto& event : in.take())
            events.push_back(std::move(event));
    }
    return true;
}

template <class Event>
std::vector<Event> only(const std::vector<dds_event>& events)
{
    std::vector<Event> out;
    for (const auto& event : events)
        if (const auto* e = std::get_if<Event>(&event))
            out.push_back(*e);
    return out;
}

// dds_peer as a child process with pipes; ended with the object.
class peer_process {
public:
    explicit peer_process(std::vector<std::string> args)
    {
        int in[2];
        int out[2];
        if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0)
            throw std::runtime_error("pipe2");
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(in[0], STDIN_FILENO);
            ::dup2(out[1], STDOUT_FILENO);
            std::vector<char*> argv{const_cast<char*>(DDS_PEER)};
            for (auto& arg : args)
                argv.push_back(arg.data());
            argv.push_back(nullptr);
            ::execv(DDS_PEER, argv.data());
            ::_exit(127);
        }
        ::close(in[0]);
        ::close(out[1]);
        in_ = in[1];
        out_ = out[0];
    }
    ~peer_process()
    {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            wait();
        }
        ::close(out_);
        close_input();
    }
    peer_process(const peer_process&) = delete;
    peer_process& operator=(const peer_process&) = delete;

    // The next line it prints, empty at its end or after the deadline.
    std::string line()
    {
        const auto end = steady::now() + deadline;
        for (;;) {
            if (const auto at = buffer_.find('\n'); at != std::string::npos) {
                const std::string found = buffer_.substr(0, at);
                buffer_.erase(0, at + 1);
                return found;
            }
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady::now()).count();
            ::pollfd ready{out_, POLLIN, 0};
            char chunk[4096];
            if (left <= 0 || ::poll(&ready, 1, static_cast<int>(left)) <= 0)
                return {};
            const auto size = ::read(out_, chunk, sizeof chunk);
            if (size <= 0)
                return {};
            buffer_.append(chunk, static_cast<std::size_t>(size));
        }
    }

    void signal(int number) const { ::kill(pid_, number); }
    void close_input()
    {
        if (in_ >= 0)
            ::close(in_);
        in_ = -1;
    }
    int wait()  // its exit code, or minus the signal
    {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    pid_t pid_ = -1;
    int in_ = -1;
    int out_ = -1;
    std::string buffer_;
};

}  // namespace plcgw::test
