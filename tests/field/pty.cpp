#include "tests/field/pty.hpp"

#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <system_error>
#include <termios.h>

namespace plcgw::field {

namespace fs = std::filesystem;

pty::pty(fs::path link)
    : link_(std::move(link)), ours_(check(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), "posix_openpt"))
{
    check(::grantpt(fd()), "grantpt");
    check(::unlockpt(fd()), "unlockpt");
    device_ = ::ptsname(fd());

    // The kernel calls a side unused only after it was open once: this opening makes that true from the start.
    const unique_fd theirs = open_theirs();
    termios settings{};
    check(::tcgetattr(theirs.get(), &settings), "tcgetattr");
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, B19200);
    check(::tcsetattr(theirs.get(), TCSANOW, &settings), "tcsetattr");

    // kill -9 of an earlier run leaves its link behind. A file that is not a link is somebody's data.
    if (fs::is_symlink(link_))
        fs::remove(link_);
    fs::create_symlink(device_, link_);
}

pty::~pty()
{
    std::error_code ignored;
    if (fs::read_symlink(link_, ignored) == device_)
        fs::remove(link_, ignored);
}

bool pty::look()
{
    pollfd state{.fd = fd(), .events = POLLIN, .revents = 0};
    ::poll(&state, 1, 0);

    const bool was_in_use = std::exchange(in_use_, (state.revents & POLLHUP) == 0);
    // A real port forgets unread bytes when it is closed; a pty would give them to whoever opens it next.
    if (was_in_use && !in_use_)
        ::tcflush(open_theirs().get(), TCIFLUSH);
    return (state.revents & POLLIN) != 0;
}

std::span<const std::uint8_t> pty::receive(std::span<std::uint8_t> room)
{
    const auto size = ::read(fd(), room.data(), room.size());
    return room.first(size > 0 ? static_cast<std::size_t>(size) : 0);
}

void pty::send(std::span<const std::uint8_t> bytes)
{
    // A port without a user would keep the bytes too, and a device that starts later would answer old requests.
    if (!in_use_)
        return;
    [[maybe_unused]] const auto sent = ::write(fd(), bytes.data(), bytes.size());
}

unique_fd pty::open_theirs() const
{
    return unique_fd(check(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), device_.string()));
}

}  // namespace plcgw::field
