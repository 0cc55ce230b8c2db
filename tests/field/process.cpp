#include "tests/field/process.hpp"

#include "tests/field/posix.hpp"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>

namespace plcgw::field {

namespace {

[[noreturn]] void become(const std::string& path, std::vector<char*> argv, int output, pid_t parent, int death_signal)
{
    ::prctl(PR_SET_PDEATHSIG, death_signal);
    if (::getppid() != parent)  // it was killed before prctl() could know
        ::_exit(1);

    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);  // exec would pass our blocked signals on
    ::dup2(output, STDOUT_FILENO);
    ::execv(path.c_str(), argv.data());
    ::_exit(127);
}

bool printed_a_line(int output)
{
    pollfd waiting{.fd = output, .events = POLLIN, .revents = 0};
    char room[256];
    return ::poll(&waiting, 1, 10'000) == 1 && ::read(output, room, sizeof room) > 0;
}

}  // namespace

pid_t start_sibling(const std::string& program, std::vector<std::string> arguments, int signal_when_orphaned)
{
    const std::string path = std::filesystem::read_symlink("/proc/self/exe").replace_filename(program).string();
    arguments.insert(arguments.begin(), path);
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);

    int ends[2];
    check(::pipe2(ends, O_CLOEXEC), "pipe2");
    const unique_fd reading(ends[0]);
    unique_fd writing(ends[1]);
    const pid_t parent = ::getpid();
    const pid_t child = check(::fork(), "fork");
    if (child == 0)
        become(path, std::move(argv), writing.get(), parent, signal_when_orphaned);

    {
        const unique_fd closed_now = std::move(writing);
    }  // else the end of a failed child would not be seen
    if (!printed_a_line(reading.get())) {
        end_process(child);
        throw std::runtime_error(program + " did not start");
    }
    return child;
}

std::optional<ended_process> reap()
{
    int status = 0;
    const pid_t pid = ::waitpid(-1, &status, WNOHANG);
    if (pid <= 0)
        return std::nullopt;
    return ended_process{pid, WIFSIGNALED(status) ? "was ended by signal " + std::to_string(WTERMSIG(status))
                                                  : "exited with " + std::to_string(WEXITSTATUS(status))};
}

void end_process(pid_t pid)
{
    ::kill(pid, SIGTERM);
    ::kill(pid, SIGCONT);  // a test may have stopped it
    for (int turn = 0; turn < 200; ++turn) {
        if (::waitpid(pid, nullptr, WNOHANG) != 0)
            return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
}

}  // namespace plcgw::field
