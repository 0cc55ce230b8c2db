#include "daemon/watch.hpp"

#include "bridge/dds/event_table.hpp"
#include "bridge/dds/event_text.hpp"
#include "bridge/dds/log.hpp"
#include "bridge/dds/subscriber.hpp"
#include "daemon/event_json.hpp"
#include "daemon/watch_terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <poll.h>
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

class watcher {
public:
    watcher(const watch_options& options, dds_subscriber& in) : options_(options), in_(in) {}

    int run(int signals);

private:
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
        if (!fits(options_.filter, event))
            continue;
        if (!show(event))
            return false;
        samples_ += is_counted(options_.filter, event) ? 1 : 0;
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
    return terminal_.draw(table_, wall_now());
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
                   "partition? `plc-gateway doctor dds` with the same options looks for the reason\n",
                   where);
    else
        fmt::print(stderr, "nothing of what is asked for was heard {}: a gateway is there, but publishes no such {}\n",
                   where, options_.filter.topics.empty() ? "registers or points" : "samples");
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
        terminal_.draw(table_, wall_now());
    return result();
}

}  // namespace

int watch(const watch_options& options)
{
    const ending_signals signals;
    set_dds_log([](dds_log_level level, const std::string& line) {
        if (level != dds_log_level::info && !terminal::is_drawn_on())
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
