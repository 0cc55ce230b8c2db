// Who was seen in the domain, and whether they meet our topics.
#include "daemon/doctor/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace plcgw {
namespace {

using weight = finding::weight;

std::string name_of(const seen_participant& p)
{
    std::string name = p.process.empty() ? "a participant that does not tell its name" : p.process;
    if (!p.host.empty())
        name += " on " + p.host;
    if (!p.addresses.empty())
        name += " at " + p.addresses;
    return name;
}

std::string quoted(const std::vector<std::string>& partitions)
{
    if (partitions.empty())
        return "the default partition";
    return fmt::format("partition \"{}\"", fmt::join(partitions, "\", \""));
}

std::vector<std::string> partitions_of(const dds_settings& settings)
{
    std::vector<std::string> all = settings.partitions;
    if (!settings.partition.empty())
        all.insert(all.begin(), settings.partition);
    return all;
}

std::string cure_of(const std::string& policy, bool writes)
{
    if (policy == "reliability")
        return writes
                   ? "a best-effort writer meets best-effort readers only: set reliability in dds.topics on both sides"
                   : "let the reader ask for BEST_EFFORT, or set this topic to reliable in dds.topics";
    if (policy == "durability")
        return "ask for TRANSIENT_LOCAL of state topics, and VOLATILE of Event, SerialMessage and WriteReply";
    if (policy == "deadline")
        return "set deadline_ms of this topic in dds.topics, not longer than the reader asks for";
    if (policy == "ownership")
        return "both sides need the same ownership: SHARED, or EXCLUSIVE where a pair of gateways is configured";
    if (policy == "liveliness")
        return "the reader asks for a shorter lease, or a stricter kind, than the writer offers";
    return "Fast DDS 2.x reads XCDR1 only: final types, and XCDR1 in the writer's QoS";
}

void look_at_endpoint(const dds_settings& settings, const std::string& who, const seen_endpoint& e, findings& found)
{
    const char* const does = e.writes ? "writes" : "reads";
    if (!e.same_partition)
        found.push_back({weight::bad,
                         fmt::format("{} {} {} in {}, these settings have {}: they do not hear each other", who, does,
                                     to_string(e.topic), quoted(e.partitions), quoted(partitions_of(settings))),
                         "give both the same dds.partition; readers may use a pattern such as plant*"});
    for (const std::string& policy : e.refusals)
        found.push_back(
            {weight::bad,
             fmt::format("{} {} {} with another {}: they do not meet", who, does, to_string(e.topic), policy),
             cure_of(policy, e.writes)});
}

std::string topics_of(const seen_participant& p, bool writes)
{
    std::set<std::string_view> names;
    for (const seen_endpoint& e : p.endpoints)
        if (e.writes == writes && e.same_partition && e.refusals.empty())
            names.insert(to_string(e.topic));
    return names.empty() ? std::string() : fmt::format(", {} {}", writes ? "writes" : "reads", fmt::join(names, " "));
}

std::string where_to_look(const dds_settings& settings)
{
    const unsigned base = 7400 + 250 * settings.domain;
    std::string text = fmt::format(
        "is the gateway running, with dds.enabled and domain {}? A firewall has to let UDP ports {} to {} in on both "
        "hosts",
        settings.domain, base, base + 10 + 2 * 31 + 1);
    if (settings.interface == "lo")
        return text + ". interface \"lo\" is this host only: name a network interface to hear others";
    return text + ". Networks of containers and many wireless ones carry no multicast: name the other hosts in "
                  "dds.peers, on both sides";
}

}  // namespace

void look_at_participants(const dds_settings& settings, const std::vector<seen_participant>& seen, unsigned seconds,
                          findings& found)
{
    bool has_topics = false;
    for (const seen_participant& each : seen) {
        const std::string who = name_of(each);
        found.push_back({weight::good, who + topics_of(each, true) + topics_of(each, false), {}});
        for (const seen_endpoint& endpoint : each.endpoints) {
            has_topics = true;
            look_at_endpoint(settings, who, endpoint, found);
        }
    }
    if (seen.empty())
        found.push_back({weight::bad,
                         fmt::format("nobody else was seen on domain {} within {} s", settings.domain, seconds),
                         where_to_look(settings)});
    else if (!has_topics)
        found.push_back({weight::note, "none of them reads or writes a topic of plc-gateway", {}});
}

}  // namespace plcgw
