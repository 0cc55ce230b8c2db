#include "daemon/watch.hpp"

#include "bridge/dds/event_table.hpp"
#include "bridge/dds/event_text.hpp"
#include "bridge/dds/log.hpp"
#include "bridge/dds/subscriber.hpp"
#include "daemon/event_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace plcgw {
namespace {

using namespace std::chrono_literals;
using steady = std::chrono::steady_clock;

using tenths = std::chrono::duration<int, std::deci>;  // of a second

constexpr auto hint_after = 5s;
constexpr auto redraw_at_most = 200ms;
constexpr auto redraw_at_least = 1s;  // ages grow without an event

wall_time wall_now()
{
    return wall_time{std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
}

std::atomic<bool> table_on_screen = false;  // Cyclone's threads must not print into it

const std::string* route_of(const dds_event& event)
{
    if (const auto* block = std::get_if<received_block>(&event))
        return &block->value.route;
    if (const auto* gone = std::get_if<gone_block>(&event))
        return &gone->route;
    if (const auto* point = std::get_if<received_point>(&event))
        return &point->name;
    if (const auto* gone = std::get_if<gone_point>(&event))
        return &gone->name;
    if (const auto* message = std::get_if<received_message>(&event))
        return &message->value.line;
    return nullptr;
}

// Ending signals as a descriptor. Made before DDS, so that Cyclone's threads leave them blocked.
class ending_signals {
public:
    ending_signals()
    {
        ::sigset_t set;
        ::sigemptyset(&set);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            ::sigaddset(&set, signal);
        ::pthread_sigmask(SIG_BLOCK, &set, &before_);
        descriptor_ = ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
    }
    ~ending_signals()
    {
        ::signalfd_siginfo info;
        while (::read(descriptor_, &info, sizeof info) > 0) {
        }
        ::close(descriptor_);
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    ending_signals(const ending_signals&) = delete;
    ending_signals& operator=(const ending_signals&) = delete;

    int descriptor() const { return descriptor_; }

private:
    ::sigset_t before_{};
    int descriptor_ = -1;
};

// Draws over what it drew before and leaves the last table on the screen.
class terminal {
public:
    ~terminal()
    {
        if (drawn_)
            write("\x1b[?7h\x1b[?25h");  // wrap lines, show the cursor
    }

    bool draw(const event_table& table)
    {
        ::winsize size{};
        if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
            size = {.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
        const auto lines = table.lines(wall_now(), size.ws_col, std::max(size.ws_row, std::uint16_t{2}) - 1U);

        std::string out = "\x1b[?25l\x1b[?7l";
        if (drawn_ && *drawn_ > 0)
            out += fmt::format("\x1b[{}A", std::min<std::size_t>(*drawn_, size.ws_row));
        for (const auto& line : lines)
            out += fmt::format("\r\x1b[{}m{}\x1b[0m\x1b[K\n", attribute(line.style), line.text);
        out += "\x1b[J";
        drawn_ = lines.size();
        table_on_screen = true;
        return write(out);
    }

    bool drawn() const { return drawn_.has_value(); }

    static bool write(std::string_view text)
    {
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    }

private:
    static std::string_view attribute(line_style style)
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

    std::optional<std::size_t> drawn_;  // lines
};

class watcher {
public:
    watcher(const watch_options& options, dds_subscriber& in) : options_(options), in_(in) {}

    int run(int signals);

private:
    bool wanted(const dds_event& event) const;
    bool show(const dds_event& event);
    bool take();
    bool refresh(steady::time_point now);
    steady::time_point next_wake() const;
    bool enough() const { return options_.count && samples_ >= *options_.count; }
    void hint(tenths after) const;
    int result() const;

    const watch_options& options_;
    dds_subscriber& in_;
    const bool table_mode_ = !options_.json && ::isatty(STDOUT_FILENO) == 1;
    const steady::time_point start_ = steady::now();
    event_table table_;
    terminal terminal_;
    steady::time_point redrawn_{};
    bool dirty_ = false;  // the table on the screen is not the latest
    bool heard_ = false;  // anything, filters aside
    bool hinted_ = false;
    unsigned samples_ = 0;  // of registers and points, after the filters
};

bool watcher::wanted(const dds_event& event) const
{
    const auto* route = route_of(event);
    return !route || options_.filters.empty() ||
           std::ranges::any_of(options_.filters, [&](const auto& f) { return route->starts_with(f); });
}

// False when nobody reads the output any more.
bool watcher::show(const dds_event& event)
{
    if (options_.json)
        return terminal::write(json_line(event));
    const bool changed = table_.apply(event, wall_now());
    dirty_ = true;
    return table_mode_ || !changed || terminal::write(line_of(event) + '\n');
}

bool watcher::take()
{
    for (const auto& event : in_.take()) {
        heard_ = true;
        if (!wanted(event))
            continue;
        if (!show(event))
            return false;
        samples_ += std::holds_alternative<received_block>(event) || std::holds_alternative<received_point>(event);
        if (enough())
            break;
    }
    return true;
}

bool watcher::refresh(steady::time_point now)
{
    if (!table_mode_ || !heard_ || now < redrawn_ + (dirty_ ? steady::duration(redraw_at_most) : redraw_at_least))
        return true;
    redrawn_ = now;
    dirty_ = false;
    return terminal_.draw(table_);
}

steady::time_point watcher::next_wake() const
{
    auto wake = steady::now() + 1h;
    if (options_.timeout)
        wake = start_ + *options_.timeout;
    if (samples_ == 0 && !hinted_)
        wake = std::min(wake, start_ + hint_after);
    if (table_mode_ && heard_)
        wake = std::min(wake, redrawn_ + (dirty_ ? steady::duration(redraw_at_most) : redraw_at_least));
    return wake;
}

void watcher::hint(tenths after) const
{
    const auto& dds = options_.dds;
    const std::string where = fmt::format("on domain {}, {} in {:g} s", dds.domain,
                                          dds.interface.empty() ? "any interface" : "interface " + dds.interface,
                                          std::chrono::duration<double>(after).count());
    if (!heard_)
        fmt::print(stderr,
                   "nothing heard {}: is the gateway running, with dds.enabled and the same domain, interface and "
                   "partition?\n",
                   where);
    else if (options_.filters.empty())
        fmt::print(stderr, "no registers heard {}: a gateway is there, but it publishes none\n", where);
    else
        fmt::print(stderr, "no registers heard {} of a route whose name begins with {}\n", where,
                   fmt::join(options_.filters, " or "));
}

int watcher::result() const
{
    if (options_.count && !enough() && samples_ > 0)
        fmt::print(stderr, "{} of {} samples came\n", samples_, *options_.count);
    if (options_.count)
        return enough() ? 0 : 1;
    return options_.timeout && samples_ == 0 ? 1 : 0;
}

int watcher::run(int signals)
{
    for (;;) {
        const auto now = steady::now();
        const bool timed_out = options_.timeout && now >= start_ + *options_.timeout;
        if (samples_ == 0 && !hinted_ && (timed_out || now >= start_ + hint_after)) {
            hinted_ = true;
            if (!terminal_.drawn() || timed_out)  // it would land in the table
                hint(std::chrono::floor<tenths>(now - start_));
        }
        if (timed_out || enough() || !refresh(now))
            break;

        const auto wake = next_wake();
        const auto wait = std::chrono::ceil<std::chrono::milliseconds>(wake - now);
        ::pollfd ready[] = {{in_.descriptor(), POLLIN, 0}, {signals, POLLIN, 0}};
        const int count = ::poll(ready, 2, static_cast<int>(std::clamp(wait, 0ms, 60'000ms).count()));
        if (count > 0 && ready[1].revents != 0)
            break;
        if (count > 0 && !take())
            break;
    }
    if (table_mode_ && dirty_)
        terminal_.draw(table_);
    return result();
}

}  // namespace

int watch(const watch_options& options)
{
    const ending_signals signals;
    set_dds_log([](dds_log_level level, const std::string& line) {
        if (level != dds_log_level::info && !table_on_screen)
            fmt::print(stderr, "dds: {}\n", line);
    });
    int code = 1;
    if (auto in = dds_subscriber::create(options.dds))
        code = watcher(options, *in).run(signals.descriptor());
    else
        fmt::print(stderr, "{}\n", in.error().text);
    set_dds_log({});
    return code;
}

}  // namespace plcgw
