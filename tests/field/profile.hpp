// What a simulated device does with its registers as time passes, so that the demo shows values that move.
#pragma once

#include "tests/field/modbus_handles.hpp"

#include <functional>
#include <string>
#include <vector>

namespace plcgw::field {

using profile = std::function<void(modbus_mapping_t&, double seconds)>;  // seconds since the last call

std::vector<std::string> profile_names();

// Sets the first values. README.md says what each profile keeps where.
profile start_profile(const std::string& name, modbus_mapping_t& registers);

}  // namespace plcgw::field
