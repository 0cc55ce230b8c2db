// The optimum by a sweep over the spans in the order of their first register.
//
// A request costs its block over its shortest period, so requests fall into classes by period. A request of one class
// is *open* while later spans may join it. In some optimum no span joins a request once a younger one of its class has
// begun, so that the sweep needs to know one open request in each class:
//   Let A and B be requests of one class, A beginning first or at the same register, and let spans of A begin where B
//   has begun or later. If A ends last, B's spans can go into A: A's block and period stay, one request is saved.
//   Otherwise the spans of A that begin in B can go into B: B's block and period stay, A's block shrinks and its period
//   does not get shorter, or A vanishes. What was allowed stays allowed, as both blocks are parts of old ones. No step
//   costs anything, and each makes the requests fewer, or lets spans belong to a block that begins later and none to
//   one that begins earlier: so the steps end, and where they end there is no such pair.
// The class of a request is chosen when it opens. One that gets no span of that period is priced too high, and its
// right price stands in another state.
#include "bridge/routes/plan.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace plcgw {
namespace {

constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
constexpr double rounding = 1e-12;  // of shares, which were added in different orders

double share(duration cost, duration period)
{
    return static_cast<double>(cost.count()) / static_cast<double>(period.count());
}

struct sweep_state {
    std::vector<std::optional<read_block>> open;  // of each class
    double closed = 0;                            // what the requests cost that are not open any more
    double total = 0;                             // with those that are
    std::size_t step = nobody;                    // how it came to be
};

struct sweep_step {
    std::size_t before;  // step
    std::size_t of_class;
    bool opens;
};

class sweep {
public:
    sweep(const std::vector<read_span>& spans, std::vector<std::size_t> order, const merge_rules& rules)
        : spans_(spans), order_(std::move(order)), rules_(rules)
    {
        for (const std::size_t each : order_)
            periods_.push_back(spans_[each].period);
        std::sort(periods_.begin(), periods_.end());
        periods_.erase(std::unique(periods_.begin(), periods_.end()), periods_.end());
    }

    merged_reads run()
    {
        if (order_.empty())
            return {};
        states_.push_back({std::vector<std::optional<read_block>>(periods_.size()), 0, 0, nobody});
        for (const std::size_t each : order_) {
            for (sweep_state& s : states_)
                close_what_cannot_grow(s, spans_[each].at.first);
            take(spans_[each]);
            thin_out();
        }
        const auto best = std::min_element(states_.begin(), states_.end(), by_total);
        return {requests_of(*best), complete_};
    }

private:
    static bool by_total(const sweep_state& a, const sweep_state& b) { return a.total < b.total; }

    double price(const read_block& b, std::size_t of_class)
    {
        auto [at, is_new] = costs_.try_emplace(b);
        if (is_new)
            at->second = rules_.cost(b);
        return share(at->second, periods_[of_class]);
    }

    void close_what_cannot_grow(sweep_state& s, std::uint32_t next)
    {
        for (std::size_t k = 0; k < s.open.size(); ++k) {
            if (!s.open[k] || rules_.allowed(joined(*s.open[k], {next, next + 1})))
                continue;
            s.closed += price(*s.open[k], k);
            s.open[k].reset();
        }
    }

    void take(const read_span& span)
    {
        std::vector<sweep_state> made;
        for (const sweep_state& s : states_) {
            for (std::size_t k = 0; k < periods_.size() && periods_[k] <= span.period; ++k) {
                if (s.open[k] && rules_.allowed(joined(*s.open[k], span.at)))
                    made.push_back(next(s, k, joined(*s.open[k], span.at), false));
                made.push_back(next(s, k, span.at, true));
            }
        }
        states_ = std::move(made);
    }

    sweep_state next(const sweep_state& from, std::size_t k, const read_block& block, bool opens)
    {
        sweep_state made = from;
        if (opens && made.open[k])
            made.closed += price(*made.open[k], k);
        made.open[k] = block;
        made.total = made.closed;
        for (std::size_t i = 0; i < made.open.size(); ++i)
            if (made.open[i])
                made.total += price(*made.open[i], i);
        made.step = steps_.size();
        steps_.push_back({from.step, k, opens});
        return made;
    }

    // Whatever b costs in the end, a can have for the same or less: it goes on with its own open request where that
    // lies in b's, and closes it otherwise; what b adds to a request, a puts into a new one, which is a part of b's.
    bool is_as_good(const sweep_state& a, const sweep_state& b)
    {
        double paid = a.closed;
        for (std::size_t k = 0; k < a.open.size() && paid <= b.closed + rounding; ++k)
            if (a.open[k] && !(b.open[k] && covers(*b.open[k], *a.open[k])))
                paid += price(*a.open[k], k);
        return paid <= b.closed + rounding;
    }

    void thin_out()
    {
        std::sort(states_.begin(), states_.end(), by_total);
        std::vector<sweep_state> kept;
        for (sweep_state& each : states_) {
            if (std::any_of(kept.begin(), kept.end(), [&](const sweep_state& k) { return is_as_good(k, each); }))
                continue;
            if (kept.size() == std::max<std::size_t>(rules_.most_states, 1)) {
                complete_ = false;
                break;
            }
            kept.push_back(std::move(each));
        }
        states_ = std::move(kept);
    }

    std::vector<merged_read> requests_of(const sweep_state& end) const
    {
        std::vector<sweep_step> way;
        for (std::size_t at = end.step; at != nobody; at = steps_[at].before)
            way.push_back(steps_[at]);
        std::reverse(way.begin(), way.end());
        std::vector<merged_read> made;
        std::vector<std::size_t> open(periods_.size(), nobody);
        for (std::size_t i = 0; i < way.size(); ++i) {
            const read_span& span = spans_[order_[i]];
            std::size_t& request = open[way[i].of_class];
            if (way[i].opens) {
                request = made.size();
                made.push_back({span.at, span.period, {}});
            }
            merged_read& to = made[request];
            to.at = joined(to.at, span.at);
            to.period = std::min(to.period, span.period);
            to.routes.push_back(order_[i]);
        }
        return made;
    }

    const std::vector<read_span>& spans_;
    std::vector<std::size_t> order_;
    const merge_rules& rules_;
    std::vector<duration> periods_;
    std::vector<sweep_state> states_;
    std::vector<sweep_step> steps_;
    std::map<read_block, duration> costs_;
    bool complete_ = true;
};

// By first; of those that begin together the longest first, then the fastest.
std::vector<std::size_t> sweep_order(const std::vector<read_span>& spans)
{
    std::vector<std::size_t> order(spans.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const read_span& left = spans[a];
        const read_span& right = spans[b];
        if (left.at.first != right.at.first)
            return left.at.first < right.at.first;
        return left.at.end != right.at.end ? left.at.end > right.at.end : left.period < right.period;
    });
    return order;
}

// A span inside another one that is read at least as often costs nothing in the other's request. Sorted as above, all
// spans that can cover one stand before it.
std::size_t host_of(const std::vector<read_span>& spans, const std::vector<std::size_t>& hosts, std::size_t guest)
{
    for (auto at = hosts.rbegin(); at != hosts.rend(); ++at)
        if (covers(spans[*at].at, spans[guest].at) && spans[*at].period <= spans[guest].period)
            return *at;
    return guest;
}

struct guests {
    std::vector<std::size_t> host;  // of each span: itself, or the span in whose request it is
    std::vector<std::size_t> swept;
    std::vector<std::size_t> alone;
};

guests sort_out(const std::vector<read_span>& spans, const merge_rules& rules)
{
    guests g{std::vector<std::size_t>(spans.size(), nobody), {}, {}};
    for (const std::size_t each : sweep_order(spans)) {
        const bool may_merge = rules.allowed(spans[each].at);
        const auto like = std::find_if(g.alone.begin(), g.alone.end(),
                                       [&](std::size_t other) { return spans[other].at == spans[each].at; });
        if (may_merge)
            g.host[each] = host_of(spans, g.swept, each);
        else
            g.host[each] = like == g.alone.end() ? each : *like;
        if (g.host[each] == each)
            (may_merge ? g.swept : g.alone).push_back(each);
    }
    return g;
}

}  // namespace

merged_reads merge_reads(const std::vector<read_span>& spans, const merge_rules& rules)
{
    const guests g = sort_out(spans, rules);
    merged_reads made = sweep(spans, g.swept, rules).run();
    for (const std::size_t each : g.alone)
        made.requests.push_back({spans[each].at, spans[each].period, {each}});
    std::vector<std::size_t> request_of(spans.size(), nobody);
    for (std::size_t r = 0; r < made.requests.size(); ++r)
        for (const std::size_t each : made.requests[r].routes)
            request_of[each] = r;
    for (std::size_t i = 0; i < spans.size(); ++i)
        if (g.host[i] != i)
            made.requests[request_of[g.host[i]]].routes.push_back(i);
    for (merged_read& each : made.requests)
        std::sort(each.routes.begin(), each.routes.end());
    std::stable_sort(made.requests.begin(), made.requests.end(),
                     [](const merged_read& a, const merged_read& b) { return a.at < b.at; });
    return made;
}

double bus_share(const merged_read& r, const merge_rules& rules) { return share(rules.cost(r.at), r.period); }

}  // namespace plcgw
