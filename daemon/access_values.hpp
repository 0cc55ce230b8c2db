// Values as people type them, and as they are shown.
#pragma once

#include "bridge/orders/order.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace plcgw {

// A number as an integer if it is one, "true", "false", "on" and "off" as a boolean, anything else as text.
point_value typed_value(const std::string& text);

// How to read registers: of what type, in which order. Names as in the configuration of points.
struct value_form {
    std::string type;   // empty: registers, each from -32768 to 65535
    std::string order;  // empty: ABCD
    unsigned characters = 0;
};
boost::system::result<point_form, order_outcome> form_of(const value_form& f);

// For bits 0 or 1 each, for words numbers of that type.
boost::system::result<order_values, order_outcome> values_of(const std::vector<std::string>& texts, bool are_bits,
                                                             const value_form& f);

nlohmann::json json_of(const std::optional<point_value>& value);  // null: the registers hold none

// Bits, or values of the form in words, one after the other.
std::vector<nlohmann::json> json_of(const order_values& values, const point_form& f);

}  // namespace plcgw
