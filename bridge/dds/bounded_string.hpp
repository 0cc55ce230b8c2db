// Bounded IDL strings are char[N + 1] in C. dds_write does not check that they end, so they are filled only here.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace plcgw {

// Copies what fits, cut before a UTF-8 character that does not, and always ends with a NUL.
void fill_string(std::span<char> out, std::string_view text);

// What a foreign writer sent: up to the NUL, or all of it if there is none.
std::string_view read_string(std::span<const char> in);

}  // namespace plcgw
