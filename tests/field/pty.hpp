// A pseudo-terminal that plays a serial port: we keep one side, another process opens the link as its device.
#pragma once

#include "tests/field/posix.hpp"

#include <cstdint>
#include <filesystem>
#include <span>

namespace plcgw::field {

class pty {
public:
    explicit pty(std::filesystem::path link);
    ~pty();  // their side sees a hang-up, and the link goes
    pty(const pty&) = delete;
    pty& operator=(const pty&) = delete;

    int fd() const { return ours_.get(); }
    bool in_use() const { return in_use_; }  // when look() was last called, somebody had the link open

    bool look();  // true if bytes wait
    std::span<const std::uint8_t> receive(std::span<std::uint8_t> room);
    void send(std::span<const std::uint8_t> bytes);  // never blocks: what does not fit is lost, as on a real line

private:
    unique_fd open_theirs() const;

    std::filesystem::path link_;
    unique_fd ours_;
    std::filesystem::path device_;  // /dev/pts/X
    bool in_use_ = false;
};

}  // namespace plcgw::field
