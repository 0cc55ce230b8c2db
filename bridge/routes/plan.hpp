// Which reads of one table or area of a station go into one request, so that they cost least bus time. Pure: knows no
// protocol, only what a block costs and whether it is allowed.
#pragma once

#include "protocols/time.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace plcgw {

// Registers, words or bits in a row: [first, end).
struct read_block {
    std::uint32_t first{};
    std::uint32_t end{};
    auto operator<=>(const read_block&) const = default;
};

constexpr bool covers(const read_block& all, const read_block& part)
{
    return all.first <= part.first && part.end <= all.end;
}
constexpr read_block joined(const read_block& a, const read_block& b)
{
    return {a.first < b.first ? a.first : b.first, a.end > b.end ? a.end : b.end};
}

struct read_span {  // what one route wants
    read_block at;
    duration period{1'000'000};
};

struct merged_read {  // one request
    read_block at;
    duration period{};                // the shortest of its routes
    std::vector<std::size_t> routes;  // indices of the spans, ascending
    bool operator==(const merged_read&) const = default;
};

struct merge_rules {
    // The time on the bus of one exchange. A part of a block costs at most what the block costs.
    std::function<duration(const read_block&)> cost;
    // Whether one request may carry this. Any part of an allowed block is allowed.
    std::function<bool(const read_block&)> allowed;
    std::size_t most_states = 256;  // kept while planning
};

struct merged_reads {
    std::vector<merged_read> requests;  // by first
    bool is_optimal = true;             // false: there were more states than kept, so that better may exist
};

// Least sum of cost / period. No span is cut; one that is not allowed itself shares its request with its like only.
merged_reads merge_reads(const std::vector<read_span>& spans, const merge_rules& rules);

// What one request takes of the bus: time per time.
double bus_share(const merged_read& r, const merge_rules& rules);

}  // namespace plcgw
