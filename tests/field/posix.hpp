// What the simulated field devices need of POSIX: descriptors that close themselves and signals that can be polled.
#pragma once

#include <initializer_list>
#include <string>
#include <unistd.h>
#include <utility>

namespace plcgw::field {

class unique_fd {
public:
    unique_fd() = default;
    explicit unique_fd(int fd) : fd_(fd) {}
    unique_fd(unique_fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    unique_fd& operator=(unique_fd&& other) noexcept
    {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~unique_fd()
    {
        if (fd_ >= 0)
            ::close(fd_);
    }

    int get() const { return fd_; }

private:
    int fd_ = -1;
};

// Returns the result of a system call, or throws std::system_error if it is -1.
int check(int result, const std::string& what);

// Blocks these signals for good; they arrive through the descriptor instead.
unique_fd signals_as_descriptor(std::initializer_list<int> signals);
int next_signal(const unique_fd& signals);  // 0: none

}  // namespace plcgw::field
