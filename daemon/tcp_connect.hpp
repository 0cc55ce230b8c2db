// A TCP connection to a server that is given by host name or address, for the lines that are no serial port.
#pragma once

#include "daemon/read_before.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <string>

namespace plcgw {

// Within the deadline; the name is looked up without blocking the loop. Keep-alive and no-delay are set.
asio::awaitable<boost::system::error_code> connect_before(time_point deadline, asio::ip::tcp::socket& socket,
                                                          deadline_guard<asio::ip::tcp::socket>& guard,
                                                          std::string host, unsigned port);

}  // namespace plcgw
