// Drives one serial line as MODBUS RTU client: opens the port and keeps it open, asks what the line's routes want.
#pragma once

#include "bridge/routes/modbus_line.hpp"
#include "daemon/read_before.hpp"
#include "daemon/serial_port.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

#include <array>
#include <functional>

namespace plcgw {

class serial_line {
public:
    // settle: called after each exchange, to drain what it changed.
    serial_line(asio::io_context& loop, line_config config, modbus_line& routes, std::function<void()> settle);

    asio::awaitable<void> run();  // until the io_context ends
    void wake();                  // a write is due

private:
    boost::system::error_code open();
    asio::awaitable<void> wait_for_port();
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> listen_until(time_point deadline);
    asio::awaitable<boost::system::error_code> exchange(modbus_line::question question);
    asio::awaitable<boost::system::error_code> send(bytes adu);

    line_config config_;
    modbus_line& routes_;
    std::function<void()> settle_;
    asio::serial_port port_;
    deadline_guard<asio::serial_port> guard_;
    asio::steady_timer reopen_;
    std::array<std::uint8_t, 1024> received_{};
    duration gap_;
    time_point line_free_from_{};
    bool idle_ = false;    // waiting until something is due
    bool absent_ = false;  // and said so
};

}  // namespace plcgw
