#include "tests/bench/stillness.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <string>
#include <unistd.h>

namespace plcgw::bench {
namespace {

constexpr nanoseconds usual = 300'000;  // a wake-up of a machine that is busy

// Ticks that the hypervisor gave to others, of all processors: the eighth figure of the first line.
std::uint64_t stolen_ticks()
{
    std::ifstream stat("/proc/stat");
    std::string cpu;
    std::uint64_t ticks = 0;
    stat >> cpu;
    for (int column = 0; column < 8; ++column)
        stat >> ticks;
    return stat ? ticks : 0;
}

}  // namespace

void stillness::note_late(nanoseconds lateness)
{
    ++wakes_;
    late_ += lateness;
    worst_ = std::max(worst_, lateness);
    if (lateness > usual)
        still_ += lateness;
}

void stillness::begin(nanoseconds now)
{
    *this = {};
    since_ = now;
    stolen_before_ = stolen_ticks();
}

nlohmann::json stillness::report(nanoseconds now) const
{
    const double seconds = static_cast<double>(now - since_) / 1e9;
    const double stolen = static_cast<double>(stolen_ticks() - stolen_before_) /
                          static_cast<double>(::sysconf(_SC_CLK_TCK) * ::sysconf(_SC_NPROCESSORS_ONLN)) / seconds;
    const double hop =
        hops_.empty() ? 0 : std::accumulate(hops_.begin(), hops_.end(), 0.0) / static_cast<double>(hops_.size());
    const double still = static_cast<double>(still_) / 1e9 / seconds;
    return {{"seconds", seconds},
            {"stolen", stolen},
            {"still", still},
            {"mean_hop_us", hop / 1000},
            {"worst_hop_us",
             hops_.empty() ? 0.0 : static_cast<double>(*std::max_element(hops_.begin(), hops_.end())) / 1000},
            {"worst_late_us", static_cast<double>(worst_) / 1000},
            {"mean_late_us", wakes_ == 0 ? 0.0 : static_cast<double>(late_) / static_cast<double>(wakes_) / 1000}};
}

}  // namespace plcgw::bench
