// IP addresses in a configuration.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <optional>
#include <string>

namespace plcgw::config {

std::optional<boost::asio::ip::address> ip_address(const std::string& text);  // nothing when it is no address

// Whether servers on both addresses cannot have the same port.
bool exclude_each_other(boost::asio::ip::address a, boost::asio::ip::address b);

}  // namespace plcgw::config
