// A search for stations on a line that works: its questions go when the line has time for them.
#include "bridge/routes/client_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration patience = std::chrono::seconds(10);  // with somebody who started a scan and does not look at it

// Stations of one line are of one kind, more or less: twice the slowest one's time, but no less than adapters need.
constexpr int times_the_slowest = 2;
constexpr duration least_timeout = std::chrono::milliseconds(50);
constexpr duration unmeasured = std::chrono::milliseconds(200);

constexpr std::size_t characters_of_both = 64;  // request and answer; a device's own name may be longer

}  // namespace

void client_line::begin_scan(scan_language language, std::vector<station_number> units, std::optional<duration> timeout,
                             time_point now)
{
    std::erase_if(units, [&](station_number unit) {
        return std::any_of(stations_.begin(), stations_.end(),
                           [unit](const station& each) { return !each.name.empty() && each.unit == unit; });
    });
    scan_timing_ = options_.timing;
    scan_timing_.retries = 0;
    scan_timing_.response_timeout = timeout.value_or(scan_timeout());
    scan_.emplace(language, std::move(units));
    scan_number_ = scan_ticket{static_cast<std::uint64_t>(scan_number_) + 1};
    scan_looked_at_ = now;
    scan_goes_ = true;
}

const station_scan* client_line::look_at_scan(time_point now)
{
    scan_goes_ = scan_goes_ && !scan_->is_over() && now - scan_looked_at_ < patience;  // also while the port is absent
    scan_looked_at_ = now;
    return scan_ ? &*scan_ : nullptr;
}

duration client_line::scan_timeout() const
{
    duration slowest{};
    for (const response_times& each : times_)
        slowest = std::max(slowest, each.mean().value_or(duration{}));
    const duration derived = slowest == duration{} ? unmeasured : std::max(least_timeout, times_the_slowest * slowest);
    return std::min(derived, options_.timing.response_timeout);
}

void client_line::offer_scan(time_point now)
{
    scan_goes_ = scan_goes_ && !scan_->is_over() && now - scan_looked_at_ < patience;
    if (!scan_goes_ || !scan_->waits())
        schedule_.set_scan(std::nullopt);
    else
        schedule_.set_scan(scan_timing_.response_timeout + character_time(scan_timing_.format, characters_of_both));
}

std::optional<client_line::question> client_line::next_scan(time_point now)
{
    auto asked = scan_->next();
    if (!asked)
        return std::nullopt;
    return question{scan_number_, asked->unit, std::move(asked->asked), scan_timing_, now, {}};
}

// The scan that asked it, unless another one has begun since. What it took of the line counts in any case.
station_scan* client_line::scan_of(const question& q, time_point now)
{
    schedule_.scanned(now - q.asked_at, now);
    return std::get<scan_ticket>(q.origin) == scan_number_ ? &*scan_ : nullptr;
}

}  // namespace plcgw
