#include "tests/field/posix.hpp"

#include <cerrno>
#include <csignal>
#include <sys/signalfd.h>
#include <system_error>

namespace plcgw::field {

int check(int result, const std::string& what)
{
    if (result == -1)
        throw std::system_error(errno, std::system_category(), what);
    return result;
}

unique_fd signals_as_descriptor(std::initializer_list<int> signals)
{
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : signals)
        sigaddset(&set, signal);
    check(sigprocmask(SIG_BLOCK, &set, nullptr), "sigprocmask");
    return unique_fd(check(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK), "signalfd"));
}

int next_signal(const unique_fd& signals)
{
    signalfd_siginfo info{};
    const auto size = ::read(signals.get(), &info, sizeof info);
    return size == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
}

}  // namespace plcgw::field
