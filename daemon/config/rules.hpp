// What may be said of a key in fields.hpp: the values that it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace plcgw::config {

struct range {
    std::int64_t least;
    std::int64_t most;
};

// Not only whole ones.
struct real_range {
    double least;
    double most;
};

// A name is a DDS key and stands in logs: 1 to `most` bytes. Any other text may be empty.
struct text {
    std::size_t least = 0;
    std::size_t most = 255;
};

inline constexpr text name_rule{1, 64};

// A value that others know and that does harm here: why, and what to do.
struct refusal {
    std::string_view name;
    std::string_view why;
};

template <class Enum>
struct choice {
    std::string_view name;
    Enum value;
};

}  // namespace plcgw::config
