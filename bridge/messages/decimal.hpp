// A number as it stood in a message, exact: 00123.4 is 1234 with one place behind the point.
#pragma once

#include <cstdint>
#include <optional>

namespace plcgw::messages {

struct decimal {
    bool negative = false;
    std::uint64_t digits = 0;
    int places = 0;          // behind the point; may be negative
    bool too_large = false;  // more digits than can be kept: no value
    bool operator==(const decimal&) const = default;

    void append(unsigned digit);  // behind the others
};

// The value times 10^shift as a whole number without its sign, halves rounded away from zero; nothing when it needs
// more than 64 bits.
std::optional<std::uint64_t> magnitude(const decimal& value, int shift);

// The nearest double or float of the value times 10^shift; nothing when there is none.
std::optional<double> to_double(const decimal& value, int shift);
std::optional<float> to_float(const decimal& value, int shift);

}  // namespace plcgw::messages
