// Which requests came, and what was answered: a client repeats a request until it hears the answer, and it must not be
// executed twice. A standby member of a pair remembers what it sees, so that this holds after it has taken over, too.
#pragma once

#include "bridge/orders/order.hpp"

#include <deque>
#include <map>
#include <optional>

namespace plcgw {

struct order_key {
    std::string client;
    std::uint64_t request{};
    auto operator<=>(const order_key&) const = default;
};

class order_log {
public:
    // The oldest of more than `most` are forgotten, but none that is under way.
    explicit order_log(std::size_t most = 4096, std::size_t most_under_way = 256)
        : most_(most), most_under_way_(most_under_way)
    {
    }

    enum class role : std::uint8_t { active, standby };

    struct verdict {
        bool execute = false;                   // and tell done(), or given_up()
        std::optional<order_outcome> answer{};  // to be said now
        wall_time done = wall_time::never;      // of the answer, if somebody said when that was
    };
    verdict came(const order_key& key, role as);

    void done(const order_key& key, order_outcome outcome, wall_time at = wall_time::never);

    // This member is not active any more and says nothing: the other one does, as it knows it.
    void given_up(const order_key& key);

    // Another member of the pair answered it, whether the request itself came here or not. Of one under way here, too:
    // it counts if that is given up.
    void heard(const order_key& key, order_outcome outcome, wall_time at = wall_time::never);

    std::size_t size() const { return entries_.size(); }
    std::size_t under_way() const { return under_way_; }

private:
    struct entry {
        bool is_under_way = false;
        std::optional<order_outcome> outcome{};  // none and not under way: another member's
        wall_time done = wall_time::never;
    };

    entry& remember(const order_key& key);

    std::size_t most_;
    std::size_t most_under_way_;
    std::map<order_key, entry> entries_;
    std::deque<order_key> oldest_first_;
    std::size_t under_way_ = 0;
};

}  // namespace plcgw
