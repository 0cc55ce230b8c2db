// Prints every sample of the gateway's topics as a line of JSON.
#pragma once

#include "tests/fastdds/participant.hpp"

#include <csignal>
#include <string>
#include <vector>

namespace fast_dds {

const std::vector<std::string>& subscribed_topics();

// Runs until `stop` is set. Topics: names of subscribed_topics(). A line has the fields of a sample behind "topic" and
// "instance": "alive"; or the key alone behind "disposed"; or "topic" and "writers": how many there are now.
void subscribe(const settings& where, const std::vector<std::string>& topics, const volatile std::sig_atomic_t& stop);

}  // namespace fast_dds
