#include "daemon/address_watch.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <utility>

namespace plcgw {

address_set addresses_of(const std::string& interface)
{
    ::ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0)
        return {};
    const std::unique_ptr<::ifaddrs, decltype(&::freeifaddrs)> all(first, ::freeifaddrs);
    address_set found;
    for (const ::ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
        if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_UP) == 0)
            continue;
        const bool wanted = interface.empty() ? (each->ifa_flags & IFF_LOOPBACK) == 0 : interface == each->ifa_name;
        const auto* const at = reinterpret_cast<const ::sockaddr_in*>(each->ifa_addr);
        char text[INET_ADDRSTRLEN];
        if (wanted && ::inet_ntop(AF_INET, &at->sin_addr, text, sizeof text) != nullptr)
            found.insert(std::string(each->ifa_name) + " " + text);
    }
    return found;
}

bool address_watch::look(address_set now)
{
    const bool kept = std::includes(now.begin(), now.end(), started_with_.begin(), started_with_.end());
    if (now.empty() || (kept && !started_with_.empty())) {
        seen_.clear();
        return false;
    }
    const bool again = seen_ == now;
    seen_ = std::move(now);
    return again;
}

}  // namespace plcgw
