// Writes a request until its reply comes.
#pragma once

#include "tests/fastdds/participant.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace fast_dds {

const std::vector<std::string>& request_topics();

struct patience {
    std::chrono::milliseconds repeat{100};  // a request that is written right after the client's own match can be lost
    std::chrono::milliseconds longest{20'000};
};

// `content` is JSON with the fields of the topic's IDL. Prints the reply as a line of JSON; false: there was none.
// Throws nlohmann::json::exception for content that is no JSON, or has wrong types.
bool request(const settings& where, const std::string& topic, const std::string& content, const patience& waits);

}  // namespace fast_dds
