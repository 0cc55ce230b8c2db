// Prints every sample of the gateway's topics as a line of JSON.
#pragma once

#include "tests/fastdds/participant.hpp"

#include <csignal>
#include <string>
#include <vector>

namespace fast_dds {

const std::vector<std::string>& subscribed_topics();

// Runs until `stop` is set. Topics: names of subscribed_topics(). Each line has the fields of the sample behind "topic"
// and "instance": "alive"; or, when the instance is gone, its key behind "disposed" or "no writers".
void subscribe(const settings& where, const std::vector<std::string>& topics, const volatile std::sig_atomic_t& stop);

}  // namespace fast_dds
