// Commands for the running gateway over a Unix socket: one JSON object a line in, one out.
#pragma once

#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>

namespace plcgw {

// The answer to a command: {"ok": true, ...} or {"ok": false, "error": "what is wrong and what to do"}.
// It may take its time: the next command of the same connection waits, other connections do not.
using control_handler = std::function<asio::awaitable<nlohmann::json>(nlohmann::json command)>;

class control_server {
public:
    control_server(asio::io_context& loop, std::filesystem::path path, control_handler handler);
    ~control_server();  // removes the socket
    control_server(const control_server&) = delete;
    control_server& operator=(const control_server&) = delete;

    // Only the user and group of the gateway may connect. Replaces the socket of a gateway that was killed.
    boost::system::error_code listen();
    asio::awaitable<void> accept_clients();

    const std::filesystem::path& path() const { return path_; }

private:
    asio::awaitable<void> serve(asio::local::stream_protocol::socket client);
    asio::awaitable<std::string> answer(std::string line) const;

    std::filesystem::path path_;
    control_handler handler_;
    asio::local::stream_protocol::acceptor acceptor_;
    bool listens_ = false;
};

}  // namespace plcgw
