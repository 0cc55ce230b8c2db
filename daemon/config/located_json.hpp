// JSON with comments, and the line on which each value stands.
#pragma once

#include "daemon/config/mistake.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <string_view>

namespace plcgw::config {

struct located_json {
    nlohmann::json value;
    bool complete = false;                     // no syntax error
    std::map<std::string, std::size_t> lines;  // JSON pointer -> line of the key, or of the element in an array

    std::size_t line_of(std::string pointer) const;  // of what it stands in, if it is absent
};

// Syntax errors and keys that stand twice are mistakes.
located_json parse_located(std::string_view text, mistakes& found);

std::string escape_pointer(std::string_view key);  // RFC 6901 section 3

}  // namespace plcgw::config
