// Lists on the command line: "1-32,40", "9600,19200", "8E1,8N1".
#pragma once

#include "daemon/config/config.hpp"

#include <optional>
#include <string>
#include <vector>

namespace plcgw {

// Ascending as written, each once. Nothing when it is no list of numbers and ranges from `least` to `most`.
std::optional<std::vector<unsigned>> parse_numbers(const std::string& text, unsigned least, unsigned most);

struct scan_format {
    unsigned data_bits = 8;
    parity check = parity::even;
    unsigned stop_bits = 1;
    bool operator==(const scan_format&) const = default;
};

std::string to_string(const scan_format& f);
std::optional<std::vector<scan_format>> parse_formats(const std::string& text);
std::optional<std::vector<line_protocol>> parse_protocols(const std::string& text);  // by their names

// As it stands in a configuration: "modbus-rtu", "even".
std::string_view name_of(line_protocol p);
std::string_view name_of(parity p);

// The highest number that a station of this protocol can have, and the lowest that a scan asks: 0 is a broadcast, but
// over MODBUS TCP a unit id like any other.
unsigned highest_unit(line_protocol p);
unsigned lowest_unit(line_protocol p);

}  // namespace plcgw
