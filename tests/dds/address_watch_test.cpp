#include "daemon/address_watch.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace plcgw;

TEST_CASE("address watch: a new address asks for a new domain, an absent one waits")
{
    const address_set one{"eth0 10.0.0.1"};
    const address_set other{"eth0 10.0.0.2"};
    const address_set both{"eth0 10.0.0.1", "eth0 10.0.0.2"};

    struct row {
        const char* name;
        address_set at_start;
        std::vector<address_set> seen;
        bool anew;  // at the last look
    };
    const row rows[] = {
        {"nothing changes", one, {one, one, one}, false},
        {"the cable is out, and in again", one, {{}, {}, {}, one, one}, false},
        {"another address, once", one, {other}, false},
        {"another address stays", one, {other, other}, true},
        {"it comes after a while without any", one, {{}, {}, other, other}, true},
        {"the old one is back before the second look", one, {other, one, other}, false},
        {"one more address", one, {both, both, both}, false},
        {"one of two is gone", both, {one, one}, true},
        {"there was none at the start", {}, {{}, one, one}, true},
        {"still none", {}, {{}, {}, {}}, false},
        {"it changes at each look", one, {other, {"eth0 10.0.0.3"}, {"eth0 10.0.0.4"}}, false},
    };
    for (const row& r : rows) {
        CAPTURE(r.name);
        address_watch watch;
        watch.start(r.at_start);
        bool anew = false;
        for (const address_set& each : r.seen) {
            CHECK_FALSE(anew);
            anew = watch.look(each);
        }
        CHECK(anew == r.anew);
    }
}

TEST_CASE("address watch: the loopback has its address, an interface that does not exist has none")
{
    CHECK(addresses_of("lo") == address_set{"lo 127.0.0.1"});
    CHECK(addresses_of("nosuch0").empty());
    for (const std::string& each : addresses_of(""))
        CHECK_FALSE(each.starts_with("lo "));
}
