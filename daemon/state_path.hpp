// Where the gateway keeps what it must not forget when it ends.
#pragma once

#include <filesystem>

namespace plcgw {

// `configured` if it is not empty; else systemd's state directory, /var/lib/plc-gateway if we may use that, or the
// user's: $XDG_STATE_HOME/plc-gateway, by default ~/.local/state/plc-gateway. Empty when there is none of these.
std::filesystem::path state_folder(const std::string& configured);

}  // namespace plcgw
