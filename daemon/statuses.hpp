// How ports and devices do, published when a state changes, and now and then for their counters.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/dds_link.hpp"

namespace plcgw {

class published_statuses {
public:
    published_statuses(dds_link& dds, duration longest_silence) : dds_(dds), longest_silence_(longest_silence) {}

    // What is added lives as long as this.
    void add(const port_status& port) { ports_.push_back({&port, {}, {}, true}); }
    void add(client_line& line);  // its stations

    void look_at_states(time_point now, wall_time wall);  // after an exchange: a new state is news at once
    // Each second, for counters that moved and silences: again and again until it is false. A part at a time, so that
    // the lines do not wait for thousands of stations.
    bool look(time_point now, wall_time wall);
    void say_everything();  // with the next look()

private:
    struct port_row {
        const port_status* now;
        port_status said;
        time_point said_at{};
        bool due = true;
    };
    struct device_row {
        client_line* line;
        std::size_t station;
        device_status said;
        time_point said_at{};
        bool due = true;
    };

    void look(port_row& port, time_point now);
    void look(device_row& device, time_point now, wall_time wall);
    void say(port_row& port, time_point now);
    void say(device_row& device, const device_status& next, time_point now);
    device_status next_of(const device_row& device, wall_time wall) const;

    dds_link& dds_;
    duration longest_silence_;
    std::vector<port_row> ports_;
    std::vector<device_row> devices_;
    std::vector<client_line*> lines_;
    std::size_t looked_at_ = 0;  // ports, and behind them devices
};

}  // namespace plcgw
