// A TCP connection to a MODBUS TCP server, or to a serial device server that passes on the bytes of its line.
#pragma once

#include "daemon/line_connection.hpp"

#include <boost/asio/ip/tcp.hpp>

namespace plcgw {

class tcp_connection final : public line_connection {
public:
    tcp_connection(asio::io_context& loop, const line_config& line);

    asio::awaitable<bool> open() override;
    void close(const boost::system::error_code& why) override;
    void rest() override;
    asio::awaitable<boost::system::error_code> write(bytes adu) override;
    asio::awaitable<boost::system::result<std::size_t>> read(time_point deadline, asio::mutable_buffer into) override;
    void interrupt() override { guard_.interrupt(); }
    void missed_answer() override { ++missed_; }
    bool deaf() const override;
    std::string absence() const override { return "no connection"; }

private:
    void say_absent(const boost::system::error_code& why);

    const line_config& line_;
    asio::ip::tcp::socket socket_;
    deadline_guard<asio::ip::tcp::socket> guard_;
    asio::steady_timer pause_;
    milliseconds next_pause_;
    time_point opened_at_{};
    time_point heard_{};   // last byte, or opened
    unsigned missed_ = 0;  // answers since then
    duration patience_;
    bool wait_first_ = false;  // behind a connection that was lost
    bool said_ = false;
};

}  // namespace plcgw
