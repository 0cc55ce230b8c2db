// The merge of reads against all ways to merge them.
#include "bridge/routes/plan.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <random>
#include <set>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

// Requests of 10 ms and 1 ms for each register, of at most `most`; none may carry a refused register beside others.
struct sample_rules {
    std::uint32_t most = 20;
    std::int64_t base = 10'000;
    std::int64_t each = 1'000;
    std::uint32_t step = 1;  // registers that come in pieces, as commands of several words
    std::set<std::uint32_t> refused{};

    merge_rules rules() const
    {
        return {.cost =
                    [this](const read_block& b) {
                        return duration{base + each * static_cast<std::int64_t>((b.end - b.first + step - 1) / step)};
                    },
                .allowed =
                    [this](const read_block& b) {
                        const auto bad = refused.lower_bound(b.first);
                        return b.end - b.first <= most && (bad == refused.end() || *bad >= b.end);
                    }};
    }
};

double total(const std::vector<merged_read>& requests, const merge_rules& rules)
{
    double sum = 0;
    for (const merged_read& each : requests)
        sum += bus_share(each, rules);
    return sum;
}

// The least over all partitions of the spans; those that are not allowed themselves stay alone with their like.
class every_partition {
public:
    every_partition(const std::vector<read_span>& spans, const merge_rules& rules) : spans_(spans), rules_(rules) {}

    double least()
    {
        for (const read_span& each : spans_)
            if (!rules_.allowed(each.at))
                add_alone(each);
        alone_ = groups_.size();
        put(0);
        return best_;
    }

private:
    void add_alone(const read_span& span)
    {
        for (merged_read& each : groups_)
            if (each.at == span.at) {
                each.period = std::min(each.period, span.period);
                return;
            }
        groups_.push_back({span.at, span.period, {}});
    }

    void put(std::size_t i)
    {
        if (i == spans_.size()) {
            best_ = std::min(best_, total(groups_, rules_));
            return;
        }
        if (!rules_.allowed(spans_[i].at)) {
            put(i + 1);
            return;
        }
        for (std::size_t g = alone_; g < groups_.size(); ++g) {
            const merged_read before = groups_[g];
            groups_[g].at = joined(before.at, spans_[i].at);
            groups_[g].period = std::min(before.period, spans_[i].period);
            if (rules_.allowed(groups_[g].at))
                put(i + 1);
            groups_[g] = before;
        }
        groups_.push_back({spans_[i].at, spans_[i].period, {}});
        put(i + 1);
        groups_.pop_back();
    }

    const std::vector<read_span>& spans_;
    const merge_rules& rules_;
    std::vector<merged_read> groups_;
    std::size_t alone_ = 0;
    double best_ = 1e300;
};

read_span span(std::uint32_t first, std::uint32_t count, duration period = 1s)
{
    return {{first, first + count}, period};
}

std::string shown(const std::vector<merged_read>& requests)
{
    std::string text;
    for (const merged_read& each : requests) {
        text += text.empty() ? "" : " ";
        text += std::to_string(each.at.first) + "-" + std::to_string(each.at.end - 1) + "(";
        for (const std::size_t i : each.routes)
            text += std::to_string(i);
        text += ")";
    }
    return text;
}

}  // namespace

TEST_CASE("plan: what is merged and what is not")
{
    const struct {
        const char* name;
        std::vector<read_span> spans;
        sample_rules with;
        const char* expected;
    } rows[] = {
        {"nothing", {}, {}, ""},
        {"one", {span(5, 3)}, {}, "5-7(0)"},
        {"neighbours, in any order", {span(5, 3), span(2, 3), span(8, 1)}, {}, "2-8(012)"},
        {"a gap that is cheaper than a request", {span(0, 1), span(10, 1)}, {}, "0-10(01)"},
        {"a gap that is dearer", {span(0, 1), span(13, 1)}, {}, "0-0(0) 13-13(1)"},
        {"the largest block", {span(0, 9), span(9, 9), span(18, 9)}, {}, "0-17(01) 18-26(2)"},
        {"a slow one rides along where it costs nothing", {span(0, 9, 1s), span(3, 2, 60s)}, {}, "0-8(01)"},
        {"a slow one beside a fast one has its own request", {span(0, 1, 10ms), span(1, 9, 60s)}, {}, "0-0(0) 1-9(1)"},
        {"the slow ones meet across the fast one",
         {span(0, 2, 60s), span(2, 8, 10ms), span(10, 2, 60s)},
         {},
         "0-11(02) 2-9(1)"},
        {"a refused register", {span(0, 3), span(3, 1), span(4, 3)}, {.refused = {3}}, "0-2(0) 3-3(1) 4-6(2)"},
        {"longer than allowed: alone with its like", {span(0, 30), span(0, 30, 2s), span(4, 2)}, {}, "0-29(01) 4-5(2)"},
        {"the same twice", {span(7, 2, 5s), span(7, 2, 1s)}, {}, "7-8(01)"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        const auto rules = row.with.rules();
        const merged_reads made = merge_reads(row.spans, rules);
        CHECK(shown(made.requests) == row.expected);
        CHECK(made.is_optimal);
    }
}

TEST_CASE("plan: never dearer than the best of all partitions")
{
    std::mt19937 random(1);
    const auto below = [&random](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    constexpr duration periods[] = {100ms, 150ms, 200ms, 500ms, 1s, 5s};
    for (int round = 0; round < 1500; ++round) {
        sample_rules with{.most = 3 + below(30), .base = 1 + below(20'000), .each = below(2'000), .step = 1 + below(4)};
        for (std::uint32_t i = below(3); i != 0; --i)
            with.refused.insert(below(60));
        std::vector<read_span> spans;
        const std::uint32_t kinds = 1 + below(std::size(periods));
        for (std::uint32_t i = 1 + below(7); i != 0; --i)
            spans.push_back(span(below(50), 1 + below(12), periods[below(kinds)]));
        CAPTURE(round);
        auto rules = with.rules();
        rules.most_states = 100'000;
        const merged_reads made = merge_reads(spans, rules);
        CHECK(made.is_optimal);
        CHECK(total(made.requests, rules) == doctest::Approx(every_partition(spans, rules).least()).epsilon(1e-9));
        std::vector<bool> seen(spans.size());
        for (const merged_read& each : made.requests) {
            for (const std::size_t i : each.routes) {
                CHECK_FALSE(seen[i]);
                seen[i] = true;
                CHECK(covers(each.at, spans[i].at));
                CHECK(each.period <= spans[i].period);
            }
            CHECK((rules.allowed(each.at) || spans[each.routes[0]].at == each.at));
        }
        CHECK(std::count(seen.begin(), seen.end(), true) == static_cast<std::ptrdiff_t>(spans.size()));
    }
}

TEST_CASE(
    "plan: many routes of many periods are planned with the states that are kept, and it is said when they ran out")
{
    sample_rules with{.most = 125, .base = 12'000, .each = 1'100};
    std::vector<read_span> spans;
    for (std::uint32_t i = 0; i < 200; ++i)
        spans.push_back(span(i * 3, 2, std::chrono::milliseconds(100 + 37 * (i * 7 % 23))));
    auto rules = with.rules();
    const merged_reads all = merge_reads(spans, rules);
    rules.most_states = 1;
    const merged_reads hasty = merge_reads(spans, rules);
    CHECK_FALSE(hasty.is_optimal);
    CHECK(total(all.requests, rules) <= total(hasty.requests, rules));
    std::size_t routes = 0;
    for (const merged_read& each : hasty.requests)
        routes += each.routes.size();
    CHECK(routes == spans.size());
}

TEST_SUITE_END();
