// What the configured stations of a line did so far, for DeviceStatus: counted where questions end.
#pragma once

#include "bridge/link_status.hpp"
#include "bridge/routes/health.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace plcgw {

class station_statistics {
public:
    // Numbered as the line numbers its stations. What is said of others, which nobody configured, is not counted.
    explicit station_statistics(std::size_t stations) : stations_(stations) {}

    // Of a read route, before anything is asked: the one with the shortest period shows the achieved poll cycle.
    void add_read(std::size_t station, std::size_t route, duration period);

    void port_opened();
    void port_lost(const std::string& why);

    void unanswered(std::size_t station, bool timed_out);                            // one attempt
    void answered(std::size_t station, const std::string* refusal, wall_time wall);  // null: a good answer
    void was_read(std::size_t station, std::size_t route, time_point now);

    // After each question. reason: why there was no answer, empty if there was one.
    void is(std::size_t station, health state, const std::string& reason);

    // True when the state of a station changed since the last call.
    bool take_changed() { return std::exchange(changed_, false); }

    std::size_t size() const { return stations_.size(); }
    link_state state_of(std::size_t station) const { return stations_[station].status.state; }

    // Counters, state and detail; names, `since` and the response time are somebody else's.
    device_status status_of(std::size_t station) const;

private:
    struct row {
        device_status status;
        bool answered = false;  // since the port was opened
        std::string refusal;    // the last one
        std::optional<std::size_t> watched;
        duration watched_period{};
        time_point read_at{};
        duration cycle{};
    };

    void set(row& of, link_state state, const std::string& detail);
    row* find(std::size_t station) { return station < stations_.size() ? &stations_[station] : nullptr; }

    std::vector<row> stations_;
    bool changed_ = false;
    bool open_ = false;
};

}  // namespace plcgw
