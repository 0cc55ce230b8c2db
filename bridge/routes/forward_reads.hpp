// Reads that wait for the same station at the same time become one, as far as they overlap or touch; and values that
// were read a moment ago need no line at all.
#pragma once

#include "bridge/routes/station_question.hpp"
#include "protocols/time.hpp"

#include <deque>
#include <map>
#include <optional>

namespace plcgw {

// One read instead of two: nothing if they do not touch, or are more than one request can carry (V1.1b3 6.1 to 6.4).
std::optional<modbus::read_table> joined(const modbus::read_table& a, const modbus::read_table& b);

// The part of an answer to `whole` that answers `part`, which lies within it.
modbus::response part_of(const modbus::response& answer, const modbus::read_table& whole,
                         const modbus::read_table& part);

// An exception that may be due to registers that only another of the joined reads wanted.
bool may_be_due_to_others(const modbus::response& answer);

// What stations said lately. Whoever writes to a station forgets what it said.
class read_cache {
public:
    explicit read_cache(duration most_age = {}) : most_age_(most_age) {}  // 0: remembers nothing

    std::optional<modbus::response> find(station_number unit, const modbus::read_table& what, time_point now) const;
    // What was asked before somebody wrote is not stored: where several questions are under way it may be older.
    void store(station_number unit, const modbus::read_table& what, const modbus::response& answer, time_point asked_at,
               time_point now);
    void forget(station_number unit, time_point now);
    void forget_all() { entries_.clear(); }

private:
    struct entry {
        modbus::read_table what;
        modbus::response answer;
        time_point at{};
    };
    duration most_age_;
    std::map<station_number, std::deque<entry>> entries_;  // newest last
    std::map<station_number, time_point> written_at_;      // 0: all of them
};

}  // namespace plcgw
