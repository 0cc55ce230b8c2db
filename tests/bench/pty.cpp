#include "tests/bench/pty.hpp"

#include <cstdlib>
#include <fcntl.h>
#include <termios.h>

namespace plcgw::bench {

using field::check;

pty_pair::pty_pair() : ours(check(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), "posix_openpt"))
{
    check(::grantpt(ours.get()), "grantpt");
    check(::unlockpt(ours.get()), "unlockpt");
    device = ::ptsname(ours.get());
    theirs = field::unique_fd(check(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), device));
    termios settings{};
    check(::tcgetattr(theirs.get(), &settings), "tcgetattr");
    ::cfmakeraw(&settings);
    check(::tcsetattr(theirs.get(), TCSANOW, &settings), "tcsetattr");
}

}  // namespace plcgw::bench
