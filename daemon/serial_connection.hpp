// A serial port of this machine.
#pragma once

#include "daemon/line_connection.hpp"

#include <boost/asio/serial_port.hpp>

namespace plcgw {

class serial_connection final : public line_connection {
public:
    serial_connection(asio::io_context& loop, const line_config& line);

    ~serial_connection() override;

    asio::awaitable<bool> open() override;
    void close(const boost::system::error_code& why) override;
    void rest() override;
    asio::awaitable<boost::system::error_code> write(bytes adu) override;
    asio::awaitable<boost::system::result<std::size_t>> read(time_point deadline, asio::mutable_buffer into) override;
    void interrupt() override { guard_.interrupt(); }
    bit_errors take_bit_errors() override;
    std::optional<std::uint64_t> overruns() override;
    std::string absence() const override { return "port absent"; }

private:
    boost::system::error_code try_open();

    const line_config& line_;
    asio::serial_port port_;
    deadline_guard<asio::serial_port> guard_;
    asio::steady_timer pause_;
    milliseconds next_pause_;
    boost::system::error_code last_error_;  // and said so
    time_point opened_at_{};
    bool alive_ = false;  // something was heard since it was opened
    bool failed_at_once_ = false;
    bit_errors bit_errors_;  // as the driver counted them last
};

}  // namespace plcgw
