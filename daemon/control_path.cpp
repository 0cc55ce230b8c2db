#include "daemon/control_path.hpp"

#include <cstdlib>
#include <unistd.h>

namespace plcgw {

std::filesystem::path control_socket(const std::string& configured)
{
    namespace fs = std::filesystem;
    if (!configured.empty())
        return configured;
    constexpr const char* name = "control.sock";
    if (const char* const runtime = std::getenv("RUNTIME_DIRECTORY"))  // systemd.exec(5)
        return fs::path(runtime) / name;
    const fs::path of_service = "/run/plc-gateway";
    if (::access(of_service.c_str(), W_OK | X_OK) == 0)
        return of_service / name;
    if (const char* const user = std::getenv("XDG_RUNTIME_DIR"))
        return fs::path(user) / "plc-gateway" / name;
    return fs::path("/tmp") / ("plc-gateway-" + std::to_string(::getuid())) / name;
}

}  // namespace plcgw
