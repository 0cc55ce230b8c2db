// Where the running gateway listens for its own commands.
#pragma once

#include <filesystem>

namespace plcgw {

// `configured` if it is not empty; else control.sock in systemd's runtime directory, in /run/plc-gateway if that
// exists, in the user's runtime directory, or in a folder of the user's below /tmp.
std::filesystem::path control_socket(const std::string& configured);

}  // namespace plcgw
