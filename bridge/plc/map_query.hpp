// A question to a PLC's map, as text.
#pragma once

#include "bridge/plc/map_listing.hpp"

#include <boost/system/result.hpp>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace plcgw::plc {

// What somebody wants to know: devices (T5 of an FX3 is a contact and a value: TS5 and TN5) or a number.
using map_query = std::variant<std::vector<device>, map_address>;

// "D8015", "X17", "40001", "400001", "hr:0", "hr:0x1F4F", "coil:5", "ir:5", "di:5"; devices by the model's names. The
// error says what would be right.
boost::system::result<map_query, std::string> parse_map_query(std::string_view text, const model& m);

}  // namespace plcgw::plc
