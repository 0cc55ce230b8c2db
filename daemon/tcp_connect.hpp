// A TCP connection to a server that is given by host name or address, for the lines that are no serial port.
#pragma once

#include "daemon/look_up.hpp"

namespace plcgw {

// Within the deadline, look-up included. Keep-alive and no-delay are set.
asio::awaitable<boost::system::error_code> connect_before(time_point deadline, asio::ip::tcp::socket& socket,
                                                          deadline_guard<asio::ip::tcp::socket>& guard,
                                                          std::string host, unsigned port);

// To the first that answers. Each has an equal share of what time is left, so that a dead one does not use up all of
// it. The error is that of the last one.
asio::awaitable<boost::system::error_code> connect_to_any(time_point deadline, asio::ip::tcp::socket& socket,
                                                          deadline_guard<asio::ip::tcp::socket>& guard,
                                                          tcp_endpoints endpoints);

}  // namespace plcgw
