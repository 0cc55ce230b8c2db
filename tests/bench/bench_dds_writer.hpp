// A writer of Point or RegisterBlock that does nothing else: what Cyclone itself needs with our types and QoS.
#pragma once

#include "tests/bench/bench_dds_entities.hpp"

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <chrono>
#include <thread>

namespace plcgw::bench {

struct load {
    bool blocks;                       // RegisterBlock of 10 words; else Point
    unsigned instances;                // written in turn, the first round at once
    unsigned burst;                    // samples at a time
    std::chrono::microseconds period;  // of the bursts; 0: without a pause
};

class writer {
public:
    writer(const dds_settings& settings, const load& wanted);  // throws std::runtime_error
    ~writer();
    writer(const writer&) = delete;

    nlohmann::json report();  // {"written": N, "failed": N} of the window; a new window

private:
    dds_parts parts_;
    load wanted_;
    dds_entity_t to_;
    std::atomic<std::uint64_t> written_ = 0;
    std::atomic<std::uint64_t> failed_ = 0;
    std::atomic<bool> ended_ = false;
    std::thread thread_;

    void run();
    void write(unsigned instance, std::uint64_t number);
};

}  // namespace plcgw::bench
