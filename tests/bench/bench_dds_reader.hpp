// A subscriber that counts and notes what it takes, on Cyclone's own thread: the least that a subscriber can do.
#pragma once

#include "tests/bench/bench_dds_entities.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace plcgw::bench {

struct heard_block {
    std::string route;
    std::uint16_t value;  // first word
    std::int64_t source_ns;
    std::int64_t at_ns;  // CLOCK_MONOTONIC, after it was taken
};

class reader {
public:
    explicit reader(const dds_settings& settings);  // throws std::runtime_error
    ~reader();
    reader(const reader&) = delete;

    nlohmann::json report();  // {"points": N, "blocks": N, "heard": [[route, value, source_ns, at_ns]]}; a new window

private:
    dds_parts parts_;
    std::mutex mutex_;
    std::uint64_t points_ = 0;
    std::vector<heard_block> heard_;

    void take_blocks(dds_entity_t from);
    void take_points(dds_entity_t from);
};

}  // namespace plcgw::bench
