// The command line of `watch` and `doctor dds`: their options, from the command line or from the configuration of the
// gateway that is looked for.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/watch.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plcgw {

// Where gateways are: as the gateway's own configuration says, or as it is given.
class site_arguments {
public:
    void add_to(CLI::App& command);

    // Takes what a configuration says. An exit code when it has mistakes, which are said.
    std::optional<int> load();

    dds_settings dds;
    std::optional<gateway_config> config;

private:
    std::string config_file_;
    std::vector<std::string> partitions_;
};

class watch_arguments {
public:
    void add_to(CLI::App& command);
    int run();

private:
    site_arguments site_;
    watch_options options_;
    std::vector<std::string> topics_;
    std::string device_;
    unsigned timeout_s_ = 0;
    unsigned count_ = 0;
};

class doctor_arguments {
public:
    void add_to(CLI::App& command);
    int run();

private:
    site_arguments site_;
    unsigned seconds_ = 5;
};

}  // namespace plcgw
