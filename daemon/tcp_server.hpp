// MODBUS TCP server: many clients on the memories of the simulated PLCs.
#pragma once

#include "bridge/services/modbus_service.hpp"
#include "daemon/config/config.hpp"
#include "daemon/unit_table.hpp"
#include "protocols/modbus/mbap.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <functional>
#include <memory>

namespace plcgw {

class tcp_server {
public:
    // settle: called after replies went out, to drain what the requests changed.
    tcp_server(asio::io_context& loop, tcp_server_config config, const unit_table& units, std::function<void()> settle);

    boost::system::error_code listen();
    asio::awaitable<void> accept_clients();  // until the io_context ends

    std::string endpoint() const;  // "127.0.0.1:1502", for the log

private:
    struct session;

    asio::awaitable<void> serve(asio::ip::tcp::socket client, std::string peer, std::shared_ptr<void> place);
    asio::awaitable<bool> answer(session& s);
    asio::awaitable<bool> write_replies(session& s);
    asio::awaitable<buffer> forward(const unit_target& to, bytes pdu);
    bool may_complain();
    std::shared_ptr<void> take_place();  // null when there are max_clients already

    tcp_server_config config_;
    unit_table units_;
    std::function<void()> settle_;
    asio::ip::tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    std::shared_ptr<unsigned> clients_ = std::make_shared<unsigned>(0);  // outlives the server in suspended sessions
    duration idle_timeout_;
    bool refusing_ = false;
    time_point complaints_since_{};
    unsigned complaints_ = 0;
};

}  // namespace plcgw
