// `plc-gateway scan LINE` inside the running gateway: a scan is started, looked at and ended by commands, so that none
// of them waits. It ends by itself when nobody looks at it for 10 s.
#pragma once

#include "daemon/running_line.hpp"

#include <nlohmann/json_fwd.hpp>

namespace plcgw {

// {"command": "scan", "action": "start" | "status" | "stop", "line": "line1"}; start takes "units": [1, 2, ...],
// without them all, and "timeout_ms". The answer is scan_json.hpp's with "ok": true. Without is_active, as the standby
// of a pair, nothing is started.
nlohmann::json scan_command(const std::vector<std::unique_ptr<running_line>>& lines, const nlohmann::json& what,
                            bool is_active, time_point now);

}  // namespace plcgw
