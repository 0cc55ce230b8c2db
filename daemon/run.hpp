// `plc-gateway run` and `plc-gateway check`.
#pragma once

#include <filesystem>

namespace plcgw {

// Exit status: 0 after SIGTERM or SIGINT, 1 when the configuration is wrong, 3 when a server cannot listen: the first
// does not heal by itself, the other may, so systemd starts it again.
int run(const std::filesystem::path& config_file);

// Exit status: 0 when the configuration is right (warnings are printed), 1 when it has mistakes.
int check(const std::filesystem::path& config_file);

}  // namespace plcgw
