// A typed engineering value on top of the words of a PLC.
#pragma once

#include "bridge/plc/memory.hpp"
#include "bridge/points/value_type.hpp"
#include "bridge/routes/quality.hpp"
#include "protocols/time.hpp"

#include <boost/system/result.hpp>

#include <string>

namespace plcgw {

enum class outside_limits : std::uint8_t {
    clamp,      // the nearest limit stands for the value, read and written
    reject,     // the last value inside stays, of quality "out of limits"; a write is refused
    uncertain,  // the value is shown, of quality "out of limits"; a write is refused
};

struct point_limits {
    std::optional<double> least;
    std::optional<double> most;
    outside_limits outside = outside_limits::uncertain;
};

// How a value of a point stands in registers, and what it means: value = number in the registers x scale + offset.
struct point_form {
    value_type type = value_type::int16;
    byte_order order = byte_order::abcd;
    std::size_t characters = 0;  // of text, 1 to 255
    double scale = 1;            // not 0
    double offset = 0;
    point_limits limits{};
};

enum class point_kind : std::uint8_t { none, boolean, integer, real, text };  // as KIND_* of registers.idl

// As in registers.idl: real stands for every kind but text.
struct point_value {
    point_kind kind{};
    double real{};
    std::int64_t integer{};
    std::string text;
    bool operator==(const point_value&) const = default;
};

point_value boolean_value(bool on);
point_value integer_value(std::int64_t number);
point_value real_value(double number);  // integer is truncated, saturated; 0 of a NaN
point_value text_value(std::string text);

// Nothing when the registers hold no value: a NaN or an infinity, or digits that are none in BCD. Whole numbers without
// scale and offset are integers, exact; of these, uint64 above the largest int64 is real. Limits are not looked at.
std::optional<point_value> decode(const point_form& f, const_register_span from);

// Whether a value is inside. Text always is.
bool is_inside(const point_limits& l, const point_value& value);
point_value clamped(const point_limits& l, const point_value& value);

enum class point_fault : std::uint8_t {
    unknown = 1,   // no point has this name
    read_only,     // it is not "writable", or its devices are filled from elsewhere
    wrong_kind,    // a text for a number, or the other way round
    out_of_range,  // does not fit the type
    outside,       // its limits
    too_long,      // more text than there is room
};

struct point_refusal {
    point_fault why{};
    std::string text;  // for people: what, and what would do
    bool operator==(const point_refusal&) const = default;
};

template <class T>
using point_result = boost::system::result<T, point_refusal>;

// The registers of a value that somebody wants written. What the type cannot hold is refused; what is not whole is
// rounded to the nearest number in the registers, halves away from zero. `kind` says which member counts; a boolean
// takes 0 and 1.
point_result<std::vector<std::uint16_t>> encode(const point_form& f, const point_value& value);

}  // namespace plcgw
