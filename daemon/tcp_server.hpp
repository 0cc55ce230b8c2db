// MODBUS TCP server: many clients on the memories of the simulated PLCs.
#pragma once

#include "bridge/services/modbus_service.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"
#include "protocols/modbus/mbap.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <functional>
#include <memory>

namespace plcgw {

// Which PLC answers a unit id; null: exception 0A, there is no path to it.
using unit_table = std::array<plc::simulated_plc*, 256>;

class tcp_server {
public:
    // settle: called after replies went out, to drain what the requests changed.
    tcp_server(asio::io_context& loop, tcp_server_config config, const unit_table& units, std::function<void()> settle);

    boost::system::error_code listen();
    asio::awaitable<void> accept_clients();  // until the io_context ends

    std::string endpoint() const;  // "127.0.0.1:1502", for the log

private:
    asio::awaitable<void> serve(asio::ip::tcp::socket client, std::string peer, std::shared_ptr<void> place);
    bool answer(modbus::mbap_framer& in, buffer& replies);
    std::shared_ptr<void> take_place();  // null when there are max_clients already

    tcp_server_config config_;
    unit_table units_;
    std::function<void()> settle_;
    asio::ip::tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    std::shared_ptr<unsigned> clients_ = std::make_shared<unsigned>(0);  // outlives the server in suspended sessions
    bool refusing_ = false;
};

}  // namespace plcgw
