// Looks up a host's addresses without letting the loop, or the end of the process, wait for a name server.
#pragma once

#include "daemon/read_before.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <functional>
#include <string>
#include <vector>

namespace plcgw {

using tcp_endpoints = std::vector<asio::ip::tcp::endpoint>;

// Blocks until it is done: getaddrinfo, or a stand-in.
using resolver = std::function<boost::system::result<tcp_endpoints>(const std::string& host, unsigned port)>;

boost::system::result<tcp_endpoints> ask_resolver(const std::string& host, unsigned port);

// An address needs no resolver. A name is looked up in a thread of its own, which is left to itself when the deadline
// comes first: asio::error::timed_out.
asio::awaitable<boost::system::result<tcp_endpoints>> look_up(time_point deadline, asio::any_io_executor executor,
                                                              std::string host, unsigned port, resolver resolve);

}  // namespace plcgw
