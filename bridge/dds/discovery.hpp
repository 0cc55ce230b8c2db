// Who else is in the domain, and whether our topics would meet theirs: for `plc-gateway doctor dds`.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/settings.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace plcgw {

// A reader or writer of one of our topics.
struct seen_endpoint {
    dds_topic topic{};
    bool writes{};
    std::vector<std::string> partitions;  // empty: the default one
    bool same_partition{};                // as one of ours
    std::vector<std::string> refusals;    // QoS policies that keep it from meeting us: "reliability"
};

struct seen_participant {
    std::string host;       // as far as it says so: Cyclone DDS does
    std::string process;    // with its process id
    std::string addresses;  // where it listens
    std::vector<seen_endpoint> endpoints;
};

class dds_discovery {
public:
    static dds_result<dds_discovery> create(const dds_settings& settings);

    dds_discovery(dds_discovery&&) noexcept;
    dds_discovery& operator=(dds_discovery&&) noexcept;
    ~dds_discovery();

    // All but ourselves that were heard so far. Never waits.
    std::vector<seen_participant> look();

private:
    struct state;
    explicit dds_discovery(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

// DDS 1.4, 2.2.3.13: two names that are no patterns match when they are equal; one of them may be a pattern of fnmatch.
bool partition_matches(const std::string& one, const std::string& other);

}  // namespace plcgw
