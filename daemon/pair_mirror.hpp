// What the active member lets the other one know, and what the standby makes of it: memory, and what is known of
// routes.
#pragma once

#include "bridge/dds/pair_port.hpp"
#include "bridge/standby/memory_mirror.hpp"
#include "daemon/running_line.hpp"

#include <functional>
#include <map>

namespace plcgw {

class pair_mirror {
public:
    using line_list = std::vector<std::unique_ptr<running_line>>;

    // Whether this member hears on that line what its stations answer, and so knows it first.
    using hearing = std::function<bool(std::size_t line, time_point now)>;

    pair_mirror(const std::vector<std::unique_ptr<plc::simulated_plc>>& plcs, const line_list& lines, hearing hears);

    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
    {
        memory_.memory_changed(plc, changed);
    }

    // The active member. All of them work through what is new, and leave the rest for the next time.
    void say_everything();
    void say_route(const std::string& name);            // its sample goes out
    void say_writes(const running_line& line);          // those that were answered
    bool publish(pair_port& port, std::uint64_t term);  // false: more is left

    // The standby. What an older term says is passed over.
    void take(const memory_chunk& chunk, time_point now);
    void take(const route_record& record, time_point now, wall_time wall);
    bool has_heard() const { return term_ != 0; }
    const std::string& misfit() const { return misfit_; }  // what the other member has and this one has not

private:
    struct row_key {
        std::size_t line{};
        std::size_t row{};
        auto operator<=>(const row_key&) const = default;
    };
    struct chunk_key {
        const plc::simulated_plc* plc{};
        std::size_t area{};
        std::size_t chunk{};
        auto operator<=>(const chunk_key&) const = default;
    };

    memory_mirror::own_bits own_bits_of(const memory_chunk& chunk, time_point now) const;
    route_record record_of(const row_key& which, std::uint64_t term) const;
    void index(std::size_t line, std::size_t row);

    const std::vector<std::unique_ptr<plc::simulated_plc>>& plcs_;
    const line_list& lines_;
    hearing hears_;
    memory_mirror memory_;
    std::map<std::pair<std::string, bool>, row_key> rows_;  // by name, and whether it is a writing half
    std::map<chunk_key, std::vector<row_key>> filled_;      // by routes that read
    std::map<row_key, std::uint32_t> writes_;               // and how often they were answered when that was said
    std::set<row_key> changed_;
    std::uint64_t term_ = 0;
    std::string misfit_;
};

}  // namespace plcgw
