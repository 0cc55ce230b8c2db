// One client's connection to a MODBUS TCP server.
#pragma once

#include "daemon/read_before.hpp"
#include "daemon/tcp_framing.hpp"
#include "daemon/unit_table.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace plcgw {

// What the clients of one listener share.
struct tcp_service {
    std::string endpoint;  // "127.0.0.1:1502", for the log
    unit_table units;
    std::function<void()> settle;  // called after replies went out, to drain what the requests changed
    duration idle_timeout{};

    // Some in each period: a client that sends nonsense all the time does not fill the log.
    bool may_complain();

private:
    time_point complaints_since_{};
    unsigned complaints_ = 0;
};

class tcp_session {
public:
    // peer: for the log. The service outlives the session's work.
    tcp_session(asio::ip::tcp::socket client, std::string peer, std::unique_ptr<tcp_framing> framing,
                tcp_service& service);

    asio::awaitable<void> run();  // until the client leaves, or has to

private:
    asio::awaitable<bool> answer();
    asio::awaitable<bool> write_replies();
    asio::awaitable<buffer> forward(const unit_target& to, bytes pdu);

    asio::ip::tcp::socket socket_;
    deadline_guard<asio::ip::tcp::socket> guard_;
    std::string peer_;
    std::unique_ptr<tcp_framing> framing_;
    tcp_service& service_;
    buffer replies_;
    std::array<std::uint8_t, 4096> received_{};
};

}  // namespace plcgw
