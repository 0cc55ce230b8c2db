#include "daemon/watch_terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace plcgw {
namespace {

std::string_view attribute(line_style style)
{
    switch (style) {
    case line_style::plain: return "0";
    case line_style::heading: return "1";
    case line_style::warning: return "33";
    case line_style::error: return "31;1";
    case line_style::old: return "2";
    }
    return "0";
}

}  // namespace

ending_signals::ending_signals()
{
    ::sigset_t set;
    ::sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        ::sigaddset(&set, signal);
    ::pthread_sigmask(SIG_BLOCK, &set, &before_);
    descriptor_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

ending_signals::~ending_signals()
{
    ::signalfd_siginfo info;
    while (::read(descriptor_, &info, sizeof info) > 0) {
    }
    ::close(descriptor_);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

std::atomic<bool> terminal::on_screen = false;

terminal::~terminal()
{
    if (drawn_)
        write("\x1b[?7h\x1b[?25h");  // wrap lines, show the cursor
}

bool terminal::draw(const event_table& table, wall_time now)
{
    ::winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        size = {.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
    const auto lines = table.lines(now, size.ws_col, std::max(size.ws_row, std::uint16_t{2}) - 1U);

    std::string out = "\x1b[?25l\x1b[?7l";
    if (drawn_ && *drawn_ > 0)
        out += fmt::format("\x1b[{}A", std::min<std::size_t>(*drawn_, size.ws_row));
    for (const auto& line : lines)
        out += fmt::format("\r\x1b[{}m{}\x1b[0m\x1b[K\n", attribute(line.style), line.text);
    out += "\x1b[J";
    drawn_ = lines.size();
    on_screen = true;
    return write(out);
}

bool terminal::write(std::string_view text)
{
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
}

}  // namespace plcgw
