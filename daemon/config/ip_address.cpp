#include "daemon/config/ip_address.hpp"

namespace plcgw::config {

std::optional<boost::asio::ip::address> ip_address(const std::string& text)
{
    boost::system::error_code wrong;
    const auto parsed = boost::asio::ip::make_address(text, wrong);
    return wrong ? std::nullopt : std::optional(parsed);
}

// SO_REUSEADDR does not help against a socket that listens, and :: listens for IPv4 as well.
bool exclude_each_other(boost::asio::ip::address a, boost::asio::ip::address b)
{
    const auto plain = [](const boost::asio::ip::address& from) -> boost::asio::ip::address {
        if (from.is_v6() && from.to_v6().is_v4_mapped())
            return make_address_v4(boost::asio::ip::v4_mapped, from.to_v6());
        return from;
    };
    a = plain(a);
    b = plain(b);
    const bool same_family = a.is_v4() == b.is_v4();
    const bool dual = (a.is_v6() && a.is_unspecified()) || (b.is_v6() && b.is_unspecified());
    return a == b || dual || (same_family && (a.is_unspecified() || b.is_unspecified()));
}

}  // namespace plcgw::config
