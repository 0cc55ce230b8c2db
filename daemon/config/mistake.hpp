// Something wrong in a configuration file: what, where, and what to do.
#pragma once

#include <string>
#include <vector>

namespace plcgw::config {

struct mistake {
    enum class weight : unsigned char { error, warning };

    std::string pointer;  // JSON pointer (RFC 6901) of the value; empty for the whole file
    std::size_t line{};   // in the file, 1 = first; 0 = nowhere in particular
    std::string text;
    weight how = weight::error;
};

using mistakes = std::vector<mistake>;

std::size_t count_errors(const mistakes& all);  // without the warnings
bool has_errors(const mistakes& all);
std::string to_string(const std::string& file, const mistake& m);  // "etc/demo.json:12: /lines/0/parity: ..."

}  // namespace plcgw::config
