// Drives one serial line, RTU or ASCII, as MODBUS client: asks what the line's routes and others want.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/line_connection.hpp"
#include "daemon/line_driver.hpp"

#include <array>
#include <functional>

namespace plcgw {

class serial_line final : public line_driver {
public:
    // settle: called after each exchange, to drain what it changed.
    serial_line(asio::io_context& loop, line_config config, client_line& routes, std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override;

private:
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> listen_until(time_point deadline);
    asio::awaitable<boost::system::error_code> exchange(client_line::question question);

    line_config config_;
    client_line& routes_;
    std::function<void()> settle_;
    std::unique_ptr<line_connection> connection_;
    std::array<std::uint8_t, 1024> received_{};
    duration gap_;
    time_point line_free_from_{};
    bool echoes_ = false;  // found out
    bool idle_ = false;    // waiting until something is due
};

}  // namespace plcgw
