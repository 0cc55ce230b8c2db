#include "daemon/state_path.hpp"

#include <cstdlib>
#include <unistd.h>

namespace plcgw {

std::filesystem::path state_folder(const std::string& configured)
{
    namespace fs = std::filesystem;
    if (!configured.empty())
        return configured;
    if (const char* const of_systemd = std::getenv("STATE_DIRECTORY"))  // systemd.exec(5)
        return of_systemd;
    const fs::path of_service = "/var/lib/plc-gateway";
    if (::access(of_service.c_str(), W_OK | X_OK) == 0)
        return of_service;
    if (const char* const user = std::getenv("XDG_STATE_HOME"); user != nullptr && *user != '\0')
        return fs::path(user) / "plc-gateway";
    if (const char* const home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".local/state/plc-gateway";
    return {};
}

}  // namespace plcgw
