// How a route or a station does, as words that the engineer puts into a PLC's memory: docs/points.md lists them.
#pragma once

#include "bridge/points/value_type.hpp"
#include "bridge/routes/client_line.hpp"

#include <array>

namespace plcgw {

// Why a value is not good, beside the exception codes (1 to 255; of MEWTOCOL the error codes, 61 is 0x61).
enum class no_answer : std::uint16_t {
    timed_out = 0x101,    // no byte came in time
    damaged = 0x102,      // checksum, parity, half a frame ...
    unexpected = 0x103,   // a whole frame that does not fit the question
    collision = 0x104,    // the line changed what the gateway sent
    busy_line = 0x105,    // somebody else kept talking
    no_port = 0x106,      // the port or the connection is absent
    not_asked = 0x107,    // the question cannot be said in this protocol
    not_renewed = 0x108,  // not read for three periods: the line has too much to do
};

no_answer code_of(const boost::system::error_code& why);

struct status_place {
    plc::simulated_plc* plc = nullptr;
    plc::place at;
    byte_order order = byte_order::abcd;  // of the source time
};

// Quality, reason, age in seconds (65535: that or more, or never), source time as uint32 seconds since 1970, errors,
// good answers (both wrap), health of the station.
inline constexpr std::size_t route_status_words = 8;
std::array<std::uint16_t, route_status_words> status_of(const route& r, health of_station, byte_order order,
                                                        wall_time now);

// Health, routes that read or write it, those of good quality or with nothing to write yet, seconds since its last good
// answer (65535: that or more, or never).
inline constexpr std::size_t station_status_words = 4;

// The status words of the routes and stations of one line.
class status_board {
public:
    explicit status_board(const client_line& line) : line_(line) {}

    void add_route(std::size_t route, const status_place& where) { routes_.push_back({route, where}); }
    void add_station(std::size_t station, const status_place& where) { stations_.push_back({station, where}); }

    void show(wall_time now) const;

private:
    struct row {
        std::size_t what;
        status_place where;
    };
    std::array<std::uint16_t, station_status_words> status_of_station(std::size_t station, wall_time now) const;

    const client_line& line_;
    std::vector<row> routes_;
    std::vector<row> stations_;
};

}  // namespace plcgw
