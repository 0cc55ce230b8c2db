// The commands read, write and send of the control socket.
#pragma once

#include "daemon/access_target.hpp"
#include "daemon/write_service.hpp"

#include <nlohmann/json.hpp>

#include <functional>

namespace plcgw {

class access_commands {
public:
    using client_lines = std::vector<std::unique_ptr<running_line>>;

    access_commands(const gateway_config& config, const plc_list& plcs, const client_lines& lines,
                    published_points& points, write_service& writes, std::function<bool()> is_active)
        : config_(config), plcs_(plcs), lines_(lines), points_(points), writes_(writes),
          is_active_(std::move(is_active))
    {
    }

    static bool knows(const nlohmann::json& what);

    // {"command": "write", "target": "main:D100", "values": ["5"], "type": "", "order": "", "timeout_ms": 0}
    // {"command": "read", "target": "main:D100", "count": 1, "type": "", "order": "", "timeout_ms": 0}
    // {"command": "send", "line": "scale", "text": "W<CR>", "timeout_ms": 0}
    // Reply: ok, result, code and device_code as registers.idl has them, detail; of a read also values, each a name and
    // a value; error if it is not ok. A standby of a pair reads its memory only.
    asio::awaitable<nlohmann::json> answer(nlohmann::json what);

private:
    using made_order = boost::system::result<order_content, order_outcome>;

    made_order order_of(const nlohmann::json& what) const;
    made_order write_order(const nlohmann::json& what) const;
    asio::awaitable<nlohmann::json> read(nlohmann::json what);
    nlohmann::json read_point(const std::string& name) const;
    nlohmann::json read_devices(const device_target& from, std::uint32_t count, const point_form& f) const;

    const gateway_config& config_;
    const plc_list& plcs_;
    const client_lines& lines_;
    published_points& points_;
    write_service& writes_;
    std::function<bool()> is_active_;
};

}  // namespace plcgw
