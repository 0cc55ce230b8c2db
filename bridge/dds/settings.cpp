#include "bridge/dds/settings.hpp"

#include <fmt/format.h>

namespace plcgw {
namespace {

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        case '\'': out += "&apos;"; break;
        default: out += c;
        }
    return out;
}

}  // namespace

std::string cyclone_xml(const dds_settings& settings)
{
    const bool loopback = settings.interface == "lo";

    std::string interfaces;
    if (!settings.interface.empty())
        interfaces = fmt::format(R"(<Interfaces><NetworkInterface name="{}" presence_required="true"/></Interfaces>)",
                                 escaped(settings.interface));

    // lo has no MULTICAST flag: plain unicast between the participants of this host is the most robust.
    std::string peers;
    if (loopback)
        peers = R"(<Peer address="127.0.0.1"/>)";
    for (const auto& peer : settings.peers)
        peers += fmt::format(R"(<Peer address="{}"/>)", escaped(peer));
    if (!peers.empty())
        peers = "<Peers>" + peers + "</Peers>";

    // GenerateKeyhash: or Fast DDS attributes a dispose to the wrong instance. MaxAutoParticipantIndex: by default the
    // 11th process on a host fails. WriterLingerDuration: or deleting a writer waits up to 1 s for a stopped reader.
    // MultipleReceiveThreads: or deleting a domain waits for ever when its address is gone, since such a thread is
    // ended by a packet to ourselves.
    return fmt::format(R"(<CycloneDDS><Domain id="any">)"
                       R"(<General>{}<AllowMulticast>{}</AllowMulticast></General>)"
                       R"(<Discovery><ParticipantIndex>auto</ParticipantIndex>)"
                       R"(<MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>)"
                       R"(<LeaseDuration>{}ms</LeaseDuration>{}</Discovery>)"
                       R"(<Internal><GenerateKeyhash>true</GenerateKeyhash>)"
                       R"(<MultipleReceiveThreads>false</MultipleReceiveThreads>)"
                       R"(<WriterLingerDuration>0s</WriterLingerDuration></Internal>)"
                       R"(</Domain></CycloneDDS>)",
                       interfaces, loopback ? "false" : "default", settings.lease.count(), peers);
}

}  // namespace plcgw
