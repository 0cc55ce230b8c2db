// Whether this host still has the addresses on which DDS was started. Cyclone DDS 0.10 chooses them once, when its
// domain is made: behind a new address it is never heard again, until the domain is made anew.
#pragma once

#include <set>
#include <string>

namespace plcgw {

using address_set = std::set<std::string>;  // "eth0 192.168.1.5"

// IPv4 addresses of interfaces that are up. Empty: of all but the loopback.
address_set addresses_of(const std::string& interface);

class address_watch {
public:
    void start(address_set now)
    {
        started_with_ = std::move(now);
        seen_.clear();
    }

    // Looked at now and then. True when the domain has to be made anew: an address is gone and there is another one, or
    // there was none. Twice the same, since an address may come back when it is renewed; without any the domain waits.
    bool look(address_set now);

private:
    address_set started_with_;
    address_set seen_;  // the last time, if it was news
};

}  // namespace plcgw
