// What `plc-gateway watch` needs of its terminal: signals that end it, and a table that is drawn over itself.
#pragma once

#include "bridge/dds/event_table.hpp"

#include <atomic>
#include <csignal>
#include <optional>
#include <string_view>

namespace plcgw {

// Ending signals as a descriptor. Made before DDS, so that Cyclone's threads leave them blocked.
class ending_signals {
public:
    ending_signals();
    ~ending_signals();
    ending_signals(const ending_signals&) = delete;
    ending_signals& operator=(const ending_signals&) = delete;

    int descriptor() const { return descriptor_; }

private:
    ::sigset_t before_{};
    int descriptor_ = -1;
};

// Draws over what it drew before and leaves the last table on the screen.
class terminal {
public:
    terminal() = default;
    ~terminal();
    terminal(const terminal&) = delete;
    terminal& operator=(const terminal&) = delete;

    // False when nobody reads the output any more.
    bool draw(const event_table& table, wall_time now);
    static bool write(std::string_view text);

    bool drawn() const { return drawn_.has_value(); }
    static bool is_drawn_on() { return on_screen; }  // any thread: nobody else may print into the table

private:
    static std::atomic<bool> on_screen;
    std::optional<std::size_t> drawn_;  // lines
};

}  // namespace plcgw
