// The options of `plc-gateway read`, `write` and `send` on the command line.
#pragma once

#include "daemon/write_by_dds.hpp"

#include <CLI/CLI.hpp>

#include <optional>

namespace plcgw {

class access_arguments {
public:
    void add_to(CLI::App& app);  // the three subcommands

    // The exit status, if it was one of them.
    std::optional<int> run();

private:
    void add_shared(CLI::App& command);
    void add_form(CLI::App& command);
    void add_dds(CLI::App& command);

    CLI::App* read_ = nullptr;
    CLI::App* write_ = nullptr;
    CLI::App* send_ = nullptr;
    access_options options_;
    dds_access_options dds_;
    std::string text_;
    std::string config_file_;
    unsigned timeout_ms_ = 0;
    bool by_dds_ = false;
};

}  // namespace plcgw
