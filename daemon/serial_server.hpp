// A serial line on which we are server: stations of ours, each with its PLC, among the stations of others.
#pragma once

#include "bridge/services/modbus_station.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/serial_connection.hpp"
#include "protocols/modbus/rtu_bus.hpp"

#include <array>
#include <functional>

namespace plcgw {

class serial_server final : public line_driver {
public:
    // settle: called after each request, to drain what it changed.
    serial_server(asio::io_context& loop, line_config config, std::vector<modbus_station> stations,
                  std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override {}

private:
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> take(modbus::bus_event event);
    asio::awaitable<boost::system::error_code> reply(modbus_station& station, buffer pdu);

    line_config config_;
    std::vector<modbus_station> stations_;
    std::function<void()> settle_;
    serial_connection connection_;
    modbus::rtu_bus_framer in_;
    asio::steady_timer gap_;
    std::array<std::uint8_t, 1024> received_{};
};

}  // namespace plcgw
