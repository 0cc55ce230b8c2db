// Which routes the items of a line's schedule stand for: the polls of its stations, each of which serves one or more
// read routes, and its write routes. Plans the polls again when a station refuses one.
#pragma once

#include "bridge/routes/read_plan.hpp"
#include "bridge/routes/schedule.hpp"

namespace plcgw {

class line_polls {
public:
    struct item {
        std::size_t station{};
        duration period{};                // 0: a write
        std::vector<std::size_t> routes;  // of a write: one. Of a poll: none if it is not needed now
        station_place first;              // of a poll
        std::uint32_t count{};
    };

    explicit line_polls(std::vector<read_settings> stations);

    // Routes are numbered by their order here, from 0.
    void add_read(std::size_t station, wanted_read wanted);
    void add_write(std::size_t station);
    void remember(std::size_t station, station_limits limits) { stations_[station].limits = std::move(limits); }

    // Fills the schedule, once: the items in the order of their first routes.
    void plan(schedule& into);

    // Of a turn of the schedule. A poll that is not needed now stands for another one of its station.
    const item& at(std::size_t index) const;
    bool is_needed(std::size_t index) const { return !items_[index].routes.empty(); }
    std::size_t item_of_write(std::size_t route) const { return write_items_.at(route); }
    std::size_t item_of_read(std::size_t route) const;  // the poll that serves it now

    // What an answer to a poll teaches.
    struct lesson {
        bool blames_routes = false;  // the refusal is the routes' device error
        std::string text;            // for the log; empty: nothing new
    };
    lesson refused(const item& poll, const station_refusal& why, wall_time wall, time_point now, schedule& polls);
    void accepted(const item& poll, wall_time wall, time_point now, schedule& polls);
    // A station on a serial line answered; after: from the end of the request to the end of the answer.
    void responded(std::size_t station, const station_question& asked, duration after);

    const station_limits& limits_of(std::size_t station) const { return stations_[station].limits; }
    bool take_learned() { return std::exchange(learned_, false); }  // since the last call: worth keeping

private:
    struct read_route {
        std::size_t route{};
        wanted_read wanted;
    };
    struct station_reads {
        read_settings how;
        std::vector<read_route> reads;
        station_limits limits;
    };

    std::vector<item> items_of(std::size_t station) const;
    std::vector<read_block> blocks_of(const item& poll) const;
    void replan(std::size_t station, time_point now, schedule& polls);

    std::vector<station_reads> stations_;
    std::vector<item> items_;                         // numbered like the schedule's
    std::vector<std::size_t> station_of_;             // of each route
    std::map<std::size_t, std::size_t> write_items_;  // of write routes
    bool learned_ = false;
};

}  // namespace plcgw
