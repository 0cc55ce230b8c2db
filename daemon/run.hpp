// `plc-gateway run` and `plc-gateway check`.
#pragma once

#include <filesystem>

namespace plcgw {

// Exit status: 0 after SIGTERM or SIGINT, 1 when the configuration is wrong, 3 when a server cannot listen: the first
// does not heal by itself, the other may, so systemd starts it again.
int run(const std::filesystem::path& config_file);

// Exit status: 0 when the configuration is right (warnings are printed), 1 when it has mistakes, or a line that needs
// more than its time, unless that shall be a warning.
int check(const std::filesystem::path& config_file, bool overload_is_a_warning = false);

}  // namespace plcgw
