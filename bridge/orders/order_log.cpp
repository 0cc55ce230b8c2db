#include "bridge/orders/order_log.hpp"

namespace plcgw {
namespace {

const order_outcome busy{order_result::busy, 0, "too many requests are under way: repeat it later"};
const order_outcome unknown{order_result::timeout, 0,
                            "the member that was active took this request and did not say what became of it: "
                            "what the device has is not known, read it back"};

}  // namespace

order_log::verdict order_log::came(const order_key& key, role as)
{
    const auto found = entries_.find(key);
    if (as == role::standby) {
        if (found == entries_.end())
            remember(key);
        return {};
    }
    if (found == entries_.end()) {
        if (under_way_ == most_under_way_)
            return {false, busy, {}};
        remember(key).is_under_way = true;
        ++under_way_;
        return {true, {}, {}};
    }
    entry& of = found->second;
    if (of.is_under_way)
        return {};
    if (!of.outcome)
        of.outcome = unknown;
    return {false, of.outcome, of.done};
}

void order_log::done(const order_key& key, order_outcome outcome, wall_time at)
{
    const auto found = entries_.find(key);
    if (found == entries_.end() || !found->second.is_under_way)
        return;
    found->second = {false, std::move(outcome), at};
    --under_way_;
}

void order_log::given_up(const order_key& key)
{
    const auto found = entries_.find(key);
    if (found == entries_.end() || !found->second.is_under_way)
        return;
    found->second.is_under_way = false;
    --under_way_;
}

void order_log::heard(const order_key& key, order_outcome outcome, wall_time at)
{
    const auto found = entries_.find(key);
    entry& of = found == entries_.end() ? remember(key) : found->second;
    of.outcome = std::move(outcome);
    of.done = at;
}

order_log::entry& order_log::remember(const order_key& key)
{
    // Each one under way goes to the end once; they are fewer than fit.
    for (std::size_t left = oldest_first_.size(); entries_.size() >= most_ && left > 0; --left) {
        const order_key oldest = std::move(oldest_first_.front());
        oldest_first_.pop_front();
        const auto found = entries_.find(oldest);
        if (found->second.is_under_way)
            oldest_first_.push_back(oldest);
        else
            entries_.erase(found);
    }
    oldest_first_.push_back(key);
    return entries_[key];
}

}  // namespace plcgw
