#include "bridge/routes/lane_shares.hpp"

#include <algorithm>
#include <cmath>

namespace plcgw {
namespace {

// Writes and forwarded requests leave a fifth of a full line to the polls. Polls leave to the probes what these may
// take, and probes never take more, also on a line that has nothing else to do. A scan takes what the probes leave of
// that.
constexpr std::array<double, lane_count> shares{0.5, 0.3, 0.95, 0.05, 0.05};

// More is not remembered: a lane that had an idle line for itself is not shut out for longer when others come.
constexpr double deepest_debt = -500'000;

constexpr std::size_t index_of(lane of) { return static_cast<std::size_t>(of); }

}  // namespace

double lane_shares::credit(lane of, time_point now) const
{
    const account& a = accounts_[index_of(of)];
    return std::min(0.0, a.credit + shares[index_of(of)] * static_cast<double>((now - a.since).count()));
}

time_point lane_shares::credit_from(lane of) const
{
    const account& a = accounts_[index_of(of)];
    return a.since + duration(static_cast<std::int64_t>(std::ceil(-a.credit / shares[index_of(of)])));
}

void lane_shares::spent(lane of, duration took, time_point now)
{
    if (of == lane::probe)
        spent(lane::scan, took, now);
    account& a = accounts_[index_of(of)];
    const time_point began = std::max(a.since, now - took);
    const double after = credit(of, began) - static_cast<double>(took.count());
    // Probes pay everything: together they never take more than their share.
    a = {of == lane::probe ? after : std::max(after, deepest_debt), began};
}

}  // namespace plcgw
