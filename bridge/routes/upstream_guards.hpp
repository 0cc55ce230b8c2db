// Safe values for devices when whoever writes them has fallen silent: a control room that went away does not leave the
// plant with its last command.
#pragma once

#include "bridge/routes/client_line.hpp"

namespace plcgw {

struct upstream_guard {
    std::string name;  // of the route
    plc::simulated_plc* plc = nullptr;
    plc::place at;
    std::size_t bits{};
    duration longest_silence{};
    std::vector<std::uint16_t> safe;  // packed by 16
};

class upstream_guards {
public:
    void add(upstream_guard guard);

    // Who never wrote since then is missed after the longest silence, too.
    void start(time_point now);

    // Somebody wrote to a PLC: memory::take_written(). Each write counts, also of the same value.
    void written(time_point now);

    void look(time_point now);   // puts safe values where nobody wrote for too long
    time_point wake_at() const;  // when look() may have something to do; max(): never

    std::vector<line_event> take_events() { return std::exchange(events_, {}); }
    bool empty() const { return rows_.empty(); }

private:
    struct row {
        upstream_guard content;
        plc::memory::watch watch{};
        time_point until{};
        bool lost = false;
    };

    std::vector<row> rows_;
    std::vector<line_event> events_;
};

}  // namespace plcgw
