// What the stations of all lines have taught, in a small JSON file that outlives the gateway.
#pragma once

#include "bridge/routes/learned_limits.hpp"

#include <filesystem>
#include <utility>

namespace plcgw {

// Of line and unit id or station number: a device that moves to another place is another one.
using learned_by_station = std::map<std::pair<std::string, unsigned>, station_limits>;

class learned_store {
public:
    // learned.json in that folder, which need not exist; an empty path: nothing is kept.
    explicit learned_store(const std::filesystem::path& folder);

    struct loaded {
        learned_by_station stations;
        std::string problem;  // empty: none. What could not be understood is ignored as a whole
    };
    loaded load() const;  // an absent file holds nothing

    // Replaces the file at once or not at all. Returns what went wrong.
    std::string save(const learned_by_station& stations) const;

    const std::filesystem::path& file() const { return file_; }

private:
    std::filesystem::path file_;
};

}  // namespace plcgw
