// A serial port that is opened, and opened again when it comes back: absence is a normal state.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

namespace plcgw {

character_format format_of(const line_config& line);

class serial_connection {
public:
    serial_connection(asio::io_context& loop, const line_config& line);

    ~serial_connection();
    serial_connection(const serial_connection&) = delete;
    serial_connection& operator=(const serial_connection&) = delete;

    // True when it is open now; false after a failed attempt and the pause behind it, so that the caller can say so.
    asio::awaitable<bool> open();
    void close(const boost::system::error_code& why);

    // The time on the wire and a second: a driver that takes longer hangs.
    asio::awaitable<boost::system::error_code> write(bytes adu);

    asio::serial_port port;
    deadline_guard<asio::serial_port> guard;

private:
    boost::system::error_code try_open();

    const line_config& line_;
    asio::steady_timer pause_;
    milliseconds next_pause_;
    boost::system::error_code last_error_;  // and said so
    time_point opened_at_{};
    bool failed_at_once_ = false;
};

}  // namespace plcgw
