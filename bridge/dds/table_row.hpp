// Internal to bridge/dds: a row of the table of `plc-gateway watch`.
#pragma once

#include <string>
#include <string_view>

namespace plcgw {

std::string row_text(char mark, const std::string& route, const std::string& registers, std::string_view quality,
                     const std::string& age, const std::string& values);

}  // namespace plcgw
