// MODBUS TCP server: many clients on the memories of the simulated PLCs.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/tcp_session.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <functional>
#include <memory>

namespace plcgw {

class tcp_server {
public:
    // settle: called after replies went out, to drain what the requests changed.
    tcp_server(asio::io_context& loop, tcp_server_config config, const unit_table& units, through_writes& through,
               std::function<void()> settle);

    void obey(const line_voice& voice) { service_.voice = &voice; }

    boost::system::error_code listen();
    asio::awaitable<void> accept_clients();  // until stop(), or the io_context ends
    bool listens() const { return acceptor_.is_open(); }
    void stop();  // the clients are disconnected: they find the other member of the pair

    const port_status& port() const { return service_.meter.status(); }
    const std::string& endpoint() const { return service_.endpoint; }  // "127.0.0.1:1502", for the log

private:
    asio::ip::tcp::endpoint address() const;
    asio::awaitable<void> serve(asio::ip::tcp::socket client, std::string peer, std::shared_ptr<void> place);
    std::unique_ptr<tcp_framing> make_framing() const;
    std::shared_ptr<void> take_place();  // null when there are max_clients already

    tcp_server_config config_;
    tcp_service service_;
    asio::ip::tcp::acceptor acceptor_;
    asio::steady_timer pause_;
    std::shared_ptr<unsigned> clients_ = std::make_shared<unsigned>(0);  // outlives the server in suspended sessions
    bool refusing_ = false;
    unsigned turn_ = 0;                                 // of listening
    std::vector<std::weak_ptr<tcp_session>> sessions_;  // of a pair
};

}  // namespace plcgw
