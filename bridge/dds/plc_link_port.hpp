// PLC link areas between gateways: writes those of this one's stations, reads everybody's.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/settings.hpp"
#include "bridge/plc_link_area.hpp"

#include <memory>

namespace plcgw {

// Create, use and destroy on one thread. Nothing here waits.
class plc_link_port {
public:
    // lease: readers of any make notice within this time that a writer has stopped. Write more often.
    static dds_result<plc_link_port> create(const dds_settings& settings, duration lease);

    plc_link_port(plc_link_port&&) noexcept;
    plc_link_port& operator=(plc_link_port&&) noexcept;
    ~plc_link_port();

    // Link, gateway, member and station are the key. A name longer than 64 bytes is cut.
    void publish(const plc_link_area& area);
    std::uint64_t drops() const;  // what could not be written

    int descriptor() const;  // readable: call take()

    // The latest of each station since the last call, our own among them; at most some 1000.
    std::vector<plc_link_news> take();

private:
    struct state;
    explicit plc_link_port(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
