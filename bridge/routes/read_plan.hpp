// The requests by which the read routes of one station are served, in whatever tables and areas they are.
#pragma once

#include "bridge/routes/bus_cost.hpp"
#include "bridge/routes/learned_limits.hpp"

namespace plcgw {

enum class merge_mode : std::uint8_t {
    automatic,  // whatever costs least bus time
    adjacent,   // a request reads nothing that no route wants
    off,        // each route has its own request
};

// How a station is read.
struct read_settings {
    merge_mode merge = merge_mode::automatic;
    unsigned max_registers = 0;  // that the device takes in one request; 0: what the protocol allows
    unsigned max_bits = 0;
    bus_timing bus{};
};

struct wanted_read {  // of one route
    station_place there;
    std::uint32_t count{};
    duration period{1'000'000};
};

struct planned_poll {
    station_place there;
    std::uint32_t count{};
    duration period{};
    std::vector<std::size_t> routes;  // indices of the wanted reads, ascending
    duration cost{};                  // on the bus, each time
};

struct read_plan {
    std::vector<planned_poll> polls;  // by area and first
    bool is_optimal = true;           // false: too many different periods to look at everything
};

read_plan plan_reads(const std::vector<wanted_read>& wanted, const read_settings& how, const station_limits& limits);

read_block block_of(const planned_poll& p);

// What one station's table lets through in one request; for the planner, and for those who explain its plans.
class request_rules {
public:
    // area: of these wanted reads; all in the same one.
    request_rules(const std::vector<wanted_read>& area, const read_settings& how, const station_limits& limits);

    duration cost(const read_block& b) const { return exchange_time(how_.bus, question(b)); }
    bool is_too_long(const read_block& b) const;             // for protocol or configuration
    bool reads_unwanted(const read_block& b) const;          // something in it is read by no route
    const learned_limit* refused(const read_block& b) const  // nullptr: by nobody
    {
        return limits_ == nullptr ? nullptr : limits_->forbidding(b);
    }
    bool allowed(const read_block& b) const
    {
        return !is_too_long(b) && refused(b) == nullptr && !(how_.merge == merge_mode::adjacent && reads_unwanted(b));
    }
    merge_rules for_merging() const;  // valid as long as this

private:
    station_question question(const read_block& b) const
    {
        return read_question(moved_to(any_, b.first), b.end - b.first);
    }

    station_place any_;
    read_settings how_;
    const table_limits* limits_ = nullptr;
    std::vector<read_block> covered_;  // by routes; apart from each other, ascending
};

}  // namespace plcgw
