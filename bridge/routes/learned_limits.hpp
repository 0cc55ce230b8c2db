// What a station has refused to read in one request, and what its reads avoid from then on.
#pragma once

#include "bridge/routes/plan.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

// A limit that is older is tried once more.
inline constexpr std::chrono::hours limit_kept{24};

struct learned_limit {
    enum class kind : std::uint8_t {
        gap,       // no request carries any of these
        boundary,  // no request reads on both sides of at.first
        block,     // no request carries all of these, unless a route wants just these
        length,    // no request is as long as at.end; at.first is the longest that was answered so far
    } what{};
    read_block at;
    read_block request;                // that was refused
    std::optional<read_block> seam{};  // of a length: the gap or boundary that it is if longer requests are answered
    std::string reason;                // "exception 02 (illegal data address)"
    wall_time since{};
    bool on_trial = false;  // out of force until the station has answered once more
    bool operator==(const learned_limit&) const = default;
};

bool forbids(const learned_limit& limit, const read_block& request);  // whether or not it is on trial

// The longest request that a limit of length lets through: halfway between what was answered and what was refused.
std::uint32_t longest_of(const learned_limit& limit);

// "holding 4-6 are left out", as far as requests of this table are concerned.
std::string to_string(const learned_limit& limit, const std::string& area);

// Of one table or area of a station.
class table_limits {
public:
    bool allow(const read_block& request) const { return forbidding(request) == nullptr; }
    const learned_limit* forbidding(const read_block& request) const;  // nullptr: none in force

    struct lesson {
        bool blames_routes = false;            // the request carried nothing but them: it is their error
        std::optional<learned_limit> learned;  // requests change
    };
    // A request was refused for its place or its length. routes: the blocks that were wanted of it.
    lesson refused(const read_block& request, const std::vector<read_block>& routes, bool for_its_length,
                   const std::string& reason, wall_time now);

    // A request was answered. True when requests may be longer than before.
    bool accepted(const read_block& request, wall_time now);

    // The next limit that is old enough goes on trial. True when requests change.
    bool begin_trial(wall_time now);

    const std::vector<learned_limit>& all() const { return limits_; }
    void restore(const learned_limit& limit);

private:
    bool contradict_length(const read_block& accepted);
    bool reinstate(const read_block& request, wall_time now);
    bool is_second_of_its_length(const learned_limit& refused) const;
    bool is_suspected_length(const learned_limit& limit) const;
    lesson learn(learned_limit limit);

    std::vector<learned_limit> limits_;
    std::uint32_t longest_accepted_ = 0;
};

struct station_limits {
    std::map<std::string, table_limits> tables;  // by the area's name: "holding", "DT" ...
    std::optional<duration> turnaround;          // measured, smoothed
};

}  // namespace plcgw
