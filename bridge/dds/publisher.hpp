// Publishes registers, points and how the gateway does as DDS state topics, of which a late subscriber gets the last
// value of each, and what happens as events.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/gateway_status.hpp"
#include "bridge/dds/settings.hpp"
#include "bridge/line_event.hpp"
#include "bridge/link_status.hpp"
#include "bridge/points/point_table.hpp"
#include "bridge/sample.hpp"
#include "bridge/serial_message.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

// Create, use and destroy on one thread. Nothing here waits: not for a network, not for a reader that has stopped.
class dds_publisher {
public:
    // shared_lease: of a pair, whose members write the same registers and points with exclusive ownership. Then the
    // liveliness of who writes is to be asserted more often than this.
    static dds_result<dds_publisher> create(const dds_settings& settings, dds_identity who,
                                            std::optional<duration> shared_lease = {});

    void assert_liveliness();
    void set_strength(std::int32_t strength);  // of ownership: subscribers hear the strongest

    dds_publisher(dds_publisher&&) noexcept;
    dds_publisher& operator=(dds_publisher&&) noexcept;
    ~dds_publisher();

    // Route, area and first are the key: a fixed set, since Cyclone never frees all of a key's memory. A name longer
    // than 64 bytes (area: 32) is cut.
    void publish(const sample& s);
    void publish(const point_sample& point);  // its name is the key; 128 bytes
    void publish(const gateway_status& status);
    void publish(const port_status& status);
    void publish(const device_status& status);
    void publish(const serial_message& message);            // who subscribes later does not get it
    void publish(const line_event& event, wall_time when);  // the same

    // The route, point, line or station went away: readers see its instance disposed. Only the key is looked at.
    void dispose(const sample& key);
    void dispose(const point_sample& key);
    void dispose(const port_status& key);
    void dispose(const device_status& key);
    void dispose_gateway();  // this member

    // Readers that could not match since the last call, because they ask for another QoS: a sentence for each topic.
    std::vector<std::string> take_refusals();

    std::uint64_t published() const;
    std::uint64_t drops() const;     // what could not be written, e.g. more than 1024 words
    std::string last_error() const;  // why the last one was dropped, empty if none was

private:
    struct state;
    explicit dds_publisher(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
