// What somebody wants written, and what became of it: the same for DDS and for the commands of the control socket.
#pragma once

#include "bridge/plc/device.hpp"
#include "bridge/points/point.hpp"
#include "bridge/routes/station_question.hpp"
#include "protocols/bytes.hpp"

#include <string>
#include <variant>
#include <vector>

namespace plcgw {

enum class order_result : std::uint16_t {  // as RESULT_* of registers.idl
    ok,
    rejected,      // not writable, out of range, malformed
    not_found,     // no such route, point, PLC, station or line
    expired,       // did not begin in time; nothing was written
    device_error,  // the device answered, and refused
    timeout,       // nobody answered: what the device has is not known
    busy,          // too much waits, try later
    standby,       // this member of a pair is not active
    denied,        // the configuration does not allow it
};

std::string_view to_string(order_result r);  // "OK", "REJECTED", ...

struct order_outcome {
    order_result result = order_result::ok;
    std::uint16_t device_code = 0;  // exception or error code of the device's own protocol; 0: none
    std::string detail{};           // for people: what, and what would do
    bool operator==(const order_outcome&) const = default;
};

// Words, or bits packed by 16, the first in bit 0; as many as count needs.
struct order_values {
    bool are_bits = false;
    std::uint32_t count = 0;
    std::vector<std::uint16_t> words{};

    bool bit(std::size_t i) const { return (words[i / 16] >> i % 16 & 1U) != 0; }
    bool operator==(const order_values&) const = default;
};

bool is_whole(const order_values& v);  // count is not 0, and the words are as many as it needs

struct point_order {
    std::string name;
    point_value value;
    bool operator==(const point_order&) const = default;
};

// Some registers or bits of a route or published block, named as its RegisterBlock has them.
struct route_order {
    std::string route;
    std::string area;
    std::uint32_t first{};
    order_values values;
    bool operator==(const route_order&) const = default;
};

struct device_order {
    std::string plc;
    std::string device;  // the first one: "D100"
    order_values values;
};

// Past all routes, to any station of a line.
struct station_order {
    std::string line;
    station_number unit;
    station_place first;
    order_values values;
};

struct message_order {
    std::string line;
    buffer content;  // without start and end codes
    bool operator==(const message_order&) const = default;
};

using order_content = std::variant<point_order, route_order, device_order, station_order, message_order>;

struct order {
    order_content what;
    wall_time given = wall_time::never;  // when it was given, if that is known
    duration timeout{};                  // to begin within; 0: a generous time
};

// An order that has not begun by then has no effect. Time on its way counts; a clock that is ahead of ours does not.
time_point begin_by(const order& o, time_point now, wall_time wall);

}  // namespace plcgw
