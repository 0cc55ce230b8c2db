#include "bridge/routes/poll_load.hpp"

#include <algorithm>
#include <cmath>

namespace plcgw {
namespace {

constexpr int smoothing = 8;             // a transaction counts for an eighth
constexpr double memory_s = 5;           // of other work
constexpr double most_for_others = 0.8;  // the polls keep a fifth (lane_shares)

double seconds(duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

double poll_load::share_of(const poll& p)
{
    return p.asked && p.period != duration{} ? seconds(p.cost) / seconds(p.period) : 0;
}

void poll_load::took(std::size_t index, duration time)
{
    auto& each = polls_[index];
    wanted_ -= share_of(each);
    each.cost = each.cost == duration{} ? time : each.cost + (time - each.cost) / smoothing;
    wanted_ = std::max(0.0, wanted_ + share_of(each));
}

void poll_load::set_asked(std::size_t index, bool is)
{
    auto& each = polls_[index];
    wanted_ -= share_of(each);
    each.asked = is;
    wanted_ = std::max(0.0, wanted_ + share_of(each));
}

void poll_load::others_took(duration time, time_point now)
{
    others_ = others_ * std::exp(-seconds(now - others_at_) / memory_s) + seconds(time) / memory_s;
    others_at_ = now;
}

double poll_load::stretch(time_point now, unsigned parallel) const
{
    const double others = others_ * std::exp(-seconds(now - others_at_) / memory_s);
    return std::max(1.0, wanted_ / parallel / (1 - std::min(others, most_for_others)));
}

}  // namespace plcgw
