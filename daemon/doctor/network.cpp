// Interface, ports and peers, as this host has them.
#include "daemon/doctor/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ifaddrs.h>
#include <iterator>
#include <map>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace plcgw {
namespace {

using weight = finding::weight;

constexpr unsigned most_participants = 32;  // of a host: MaxAutoParticipantIndex is 31

struct interface {
    unsigned flags = 0;
    std::vector<std::string> addresses;  // IPv4
};

std::map<std::string, interface> interfaces()
{
    std::map<std::string, interface> all;
    ::ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0)
        return all;
    const std::unique_ptr<::ifaddrs, decltype(&::freeifaddrs)> list(first, ::freeifaddrs);
    for (const ::ifaddrs* each = first; each != nullptr; each = each->ifa_next) {
        interface& of = all[each->ifa_name];
        of.flags = each->ifa_flags;
        if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET)
            continue;
        char text[INET_ADDRSTRLEN];
        const auto* const at = reinterpret_cast<const ::sockaddr_in*>(each->ifa_addr);
        if (::inet_ntop(AF_INET, &at->sin_addr, text, sizeof text) != nullptr)
            of.addresses.emplace_back(text);
    }
    return all;
}

class udp_socket {
public:
    udp_socket() : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {}
    ~udp_socket()
    {
        if (descriptor_ >= 0)
            ::close(descriptor_);
    }
    udp_socket(const udp_socket&) = delete;
    udp_socket& operator=(const udp_socket&) = delete;

    int get() const { return descriptor_; }

private:
    int descriptor_;
};

::sockaddr_in address_of(const std::string& host, unsigned port)
{
    ::sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port));
    if (host.empty() || ::inet_pton(AF_INET, host.c_str(), &at.sin_addr) != 1)
        at.sin_addr.s_addr = htonl(INADDR_ANY);
    return at;
}

// DDSI-RTPS 9.6.1.1: of the participant with this index.
unsigned discovery_port(std::uint32_t domain, unsigned index) { return 7400 + 250 * domain + 10 + 2 * index; }

bool can_bind(unsigned port)
{
    const udp_socket socket;
    const ::sockaddr_in at = address_of("", port);
    return ::bind(socket.get(), reinterpret_cast<const ::sockaddr*>(&at), sizeof at) == 0;
}

// 0: somebody listens there, or is silent; else why it cannot be reached.
int knock(const std::string& host, unsigned port)
{
    constexpr int patience_ms = 300;
    const udp_socket socket;
    const ::sockaddr_in at = address_of(host, port);
    if (::connect(socket.get(), reinterpret_cast<const ::sockaddr*>(&at), sizeof at) != 0 ||
        ::send(socket.get(), "", 0, 0) < 0)
        return errno;
    ::pollfd ready{socket.get(), POLLIN | POLLERR, 0};
    if (::poll(&ready, 1, patience_ms) <= 0)
        return 0;
    int error = 0;
    ::socklen_t size = sizeof error;
    ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
}

}  // namespace

void look_at_cyclone_config(const dds_settings& settings, findings& found)
{
    if (settings.cyclone_config.empty())
        return;
    std::ifstream file(settings.cyclone_config);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (text.find('<') == std::string::npos) {
        found.push_back({weight::bad, fmt::format("{} cannot be read, or is no XML", settings.cyclone_config),
                         "correct dds.cyclone_config, or leave it out"});
        return;
    }
    found.push_back({weight::note,
                     fmt::format("{} is used in place of dds.interface, dds.peers and dds.lease_ms: what follows on "
                                 "interface and peers does not count",
                                 settings.cyclone_config),
                     {}});
    if (text.find("<GenerateKeyhash>true<") == std::string::npos)
        found.push_back({weight::bad,
                         settings.cyclone_config + " does not switch key hashes on: Fast DDS readers take the end of "
                                                   "one instance for the end of another",
                         "add <Internal><GenerateKeyhash>true</GenerateKeyhash></Internal> to its domain"});
    if (text.find("<MultipleReceiveThreads>false<") == std::string::npos)
        found.push_back({weight::bad,
                         settings.cyclone_config + " allows several receive threads: the gateway would hang when the "
                                                   "address of its interface changes",
                         "add <Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal>"});
}

void look_at_interface(const dds_settings& settings, findings& found)
{
    const auto all = interfaces();
    if (settings.interface.empty()) {
        found.push_back({weight::note, "no interface is named: Cyclone DDS takes the first suitable one", {}});
        return;
    }
    const std::string name = "interface " + settings.interface;
    const auto at = all.find(settings.interface);
    if (at == all.end()) {
        std::vector<std::string> names;
        for (const auto& [each, ignored] : all)
            names.push_back(each);
        found.push_back(
            {weight::bad, name + " does not exist", fmt::format("this host has: {}", fmt::join(names, ", "))});
        return;
    }
    const interface& of = at->second;
    if ((of.flags & IFF_UP) == 0) {
        found.push_back({weight::bad, name + " is down", "ip link set " + settings.interface + " up"});
        return;
    }
    if (of.addresses.empty()) {
        found.push_back({weight::bad, name + " has no IPv4 address", "wait for DHCP, or give it an address"});
        return;
    }
    found.push_back({weight::good, fmt::format("{} is up with {}", name, fmt::join(of.addresses, ", ")), {}});
    if ((of.flags & IFF_LOOPBACK) != 0)
        found.push_back({weight::note, name + " reaches programs of this host only", {}});
    else if ((of.flags & IFF_MULTICAST) == 0)
        found.push_back({settings.peers.empty() ? weight::bad : weight::note, name + " carries no multicast",
                         "name the other hosts in dds.peers, on both sides"});
}

void look_at_ports(const dds_settings& settings, findings& found)
{
    unsigned used = 0;
    while (used < most_participants && !can_bind(discovery_port(settings.domain, used)))
        ++used;
    const unsigned first = discovery_port(settings.domain, 0);
    const unsigned last = discovery_port(settings.domain, most_participants - 1) + 1;
    if (used == most_participants)
        found.push_back(
            {weight::bad, fmt::format("UDP ports {} to {} are all in use", first, last),
             "end other DDS programs of this host, or take another domain (`ss -lunp` shows who has them)"});
    else
        found.push_back(
            {weight::good,
             fmt::format("UDP port {} is free for domain {}{}", discovery_port(settings.domain, used), settings.domain,
                         used == 0 ? "" : fmt::format("; {} DDS programs run on this host already", used)),
             {}});
    std::ifstream range("/proc/sys/net/ipv4/ip_local_port_range");
    unsigned ephemeral = 0;
    if (range >> ephemeral && last >= ephemeral)
        found.push_back({weight::note,
                         fmt::format("the ports of domain {} ({} to {}) are among those that the kernel gives to any "
                                     "program (from {}): a domain up to {} is safer",
                                     settings.domain, first, last, ephemeral, (ephemeral - 7400 - 75) / 250),
                         {}});
}

void look_at_peers(const dds_settings& settings, findings& found)
{
    for (const std::string& peer : settings.peers) {
        ::in_addr ignored{};
        if (::inet_pton(AF_INET, peer.c_str(), &ignored) != 1) {
            found.push_back({weight::bad, "peer " + peer + " is no IPv4 address",
                             "write its address: a name would be looked up while the gateway waits"});
            continue;
        }
        const unsigned port = discovery_port(settings.domain, 0);
        const int error = knock(peer, port);
        if (error == 0)
            found.push_back({weight::good, fmt::format("there is a way to peer {}", peer), {}});
        else if (error == ECONNREFUSED)
            found.push_back({weight::note,
                             fmt::format("peer {} is there, but nobody listens on its UDP port {}: no DDS program of "
                                         "domain {} runs there, or it is not the first one",
                                         peer, port, settings.domain),
                             {}});
        else
            found.push_back({weight::bad, fmt::format("peer {} cannot be reached: {}", peer, std::strerror(error)),
                             "check the address, the routes (`ip route get " + peer + "`) and the cable"});
    }
}

}  // namespace plcgw
