// All points: which of them a change concerns, what is to be said of them, and how one is written.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/points/point.hpp"
#include "bridge/points/point_sources.hpp"

#include <deque>
#include <string_view>
#include <unordered_map>

namespace plcgw {

struct point {
    std::string name;  // "line1.boiler.temp"
    plc::simulated_plc* plc = nullptr;
    plc::place at;  // of its first register; of a boolean its bit
    point_form form;
    std::string unit;             // UCUM, at most 16 bytes
    double deadband = 0;          // a change up to this is not said
    duration longest_silence{0};  // after which it is said again; 0 = never
    bool writable = false;
};

// Bits of memory that a point covers.
std::size_t bits_of(const point& p);

struct point_sample {
    std::string_view name;  // of the table
    std::string_view unit;
    point_value value;  // kind none: never read, or no value
    quality state{};
    wall_time source{};
};

class point_table {
public:
    // Those who fill devices come before the points.
    point_sources& sources() { return sources_; }
    void add(point p);

    std::size_t size() const { return points_.size(); }
    const point& at(std::size_t index) const { return points_[index]; }
    std::optional<std::size_t> find(std::string_view name) const;

    // A value of a point in the PLC's memory, from where write routes take it to its station. Nothing changes when it
    // is refused.
    std::optional<point_refusal> write(std::string_view name, const point_value& value);

    // What concerns points; take_samples() looks at these again.
    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed, wall_time wall);
    void source_changed(const std::string& source);  // its quality or source time, by its name in sources()
    void start(time_point now, wall_time wall);
    void say_everything();
    void keep_silences(time_point now);  // those that were silent for their longest silence are said

    // Of those that changed beyond their deadband or in quality, and those to be said anyhow. At most so many points
    // are looked at: the rest stays for the next call.
    std::vector<point_sample> take_samples(time_point now, std::size_t most = 1000);
    bool has_more() const { return !waiting_.empty(); }

private:
    struct state {
        std::vector<std::uint32_t> fed_by;    // of the sources
        std::optional<point_value> accepted;  // the last value inside the limits, where others are rejected
        wall_time accepted_source{};
        point_value said;
        quality said_state{};
        wall_time changed{};  // the memory, when nobody is known to fill it
        bool waits = false;
        bool forced = true;
        bool first = true;
    };
    struct run {
        std::size_t first;
        std::size_t end;
        std::size_t point;
    };
    struct runs {
        std::vector<run> sorted;  // by their first bits
        std::size_t longest = 0;
        bool is_sorted = true;
    };
    using area_key = std::pair<const plc::simulated_plc*, std::size_t>;

    void wait_for_look(std::size_t index);
    point_sample look(std::size_t index);
    bool is_news(const point& p, const state& s, const point_sample& now) const;

    std::vector<point> points_;
    std::vector<state> states_;
    std::vector<time_point> silent_until_;  // apart: all of them are looked at each second
    std::map<area_key, runs> areas_;
    std::unordered_map<std::string_view, std::size_t> by_name_;
    std::vector<std::vector<std::size_t>> of_source_;  // points
    std::deque<std::size_t> waiting_;
    point_sources sources_;
};

}  // namespace plcgw
