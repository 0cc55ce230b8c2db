// How the DDS settings are written in JSON: visited by reader and schema, as fields.hpp.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/config/rules.hpp"

namespace plcgw::config {

inline constexpr choice<dds_reliability> reliabilities[] = {{"reliable", dds_reliability::reliable},
                                                            {"best-effort", dds_reliability::best_effort}};

enum class only_keep_last : std::uint8_t { keep_last };
inline constexpr choice<only_keep_last> histories[] = {{"keep-last", only_keep_last::keep_last}};
inline constexpr refusal refused_histories[] = {
    {"keep-all", "one reader that does not take its samples would hold up the gateway, for everybody. Take keep-last, "
                 "with a depth of events that suits your readers"}};

enum class only_final : std::uint8_t { final };
inline constexpr choice<only_final> extensibilities[] = {{"final", only_final::final}};
inline constexpr refusal refused_extensibilities[] = {
    {"appendable", "Cyclone DDS sends it as XCDR2 only, which Fast DDS 2.x cannot read: such readers would match and "
                   "get nothing. The types are final, and a new one gets new topic names"},
    {"mutable", "Cyclone DDS sends it as XCDR2 only, which Fast DDS 2.x cannot read: such readers would match and get "
                "nothing. The types are final, and a new one gets new topic names"}};

template <class Visitor>
void describe_topic(Visitor& v, topic_settings& c)
{
    only_keep_last history{};
    only_final extensibility{};
    v.optional("enabled", c.enabled, "Publish this topic");
    v.optional("reliability", c.reliability,
               "best-effort: readers that ask for reliable do not match, and who comes late waits for the next sample",
               reliabilities);
    v.optional("history", history, "There is no choice: keep-all could hold up the gateway", histories,
               refused_histories);
    v.optional("extensibility", extensibility, "There is no choice: Fast DDS 2.x reads final types only",
               extensibilities, refused_extensibilities);
}

template <class Visitor>
void describe(Visitor& v, state_topic_config& c)
{
    describe_topic(v, c);
    v.optional("deadline_ms", c.deadline,
               "DEADLINE that is offered: longer than the longest silence of the topic; 0 = none",
               range{0, 86'400'000});
}

template <class Visitor>
void describe(Visitor& v, event_topic_config& c)
{
    describe_topic(v, c);
    v.optional("depth", c.history, "Samples that are kept for a slow reader; 0 = 256", range{0, 10'000});
}

template <class Visitor>
void describe(Visitor& v, topics_config& c)
{
    v.optional("register_block", c.register_block, "Registers of routes and PLCs");
    v.optional("point", c.point, "Typed values");
    v.optional("port_status", c.port_status, "Lines, listeners and DDS itself");
    v.optional("device_status", c.device_status, "Stations");
    v.optional("gateway_status", c.gateway_status, "The gateway");
    v.optional("event", c.event, "What happens");
    v.optional("serial_message", c.serial_message, "Messages of general-purpose lines");
}

template <class Visitor>
void describe(Visitor& v, block_config& c)
{
    v.required("plc", c.plc, "Name of the simulated PLC", name_rule);
    v.required("device", c.device, "First device", text{2, 16});
    v.optional("count", c.count, "Registers, or bits of a bit device", range{1, 1024});
    v.optional("writable", c.writable, "DDS clients may write these devices, if writes are allowed at all");
}

template <class Visitor>
void describe(Visitor& v, dds_config& c)
{
    dds_settings& s = c.settings;
    v.optional("enabled", s.enabled, "Publish registers as DDS topics");
    v.optional("writes", c.writes,
               "Obey write requests of DDS clients: to writable points and blocks, and to routes that write. Whoever "
               "reaches the domain may send them");
    v.optional("domain", s.domain, "DDS domain id", range{0, 230});
    v.optional("interface", s.interface, "Network interface; lo = this host only, empty = the first suitable",
               text{0, 64});
    v.optional("peers", s.peers, "Addresses of other hosts where multicast does not reach", text{1});
    v.optional("partition", s.partition, "DDS partition, for example a plant", text{});
    v.optional("partitions", s.partitions, "More partitions in which the same is published", text{1});
    v.optional("lease_ms", s.lease, "A gateway that is not heard for this time counts as gone for its readers",
               range{500, 3'600'000});
    v.optional("cyclone_config", s.cyclone_config,
               "Configuration file of Cyclone DDS in place of interface, peers and lease_ms; relative to this file",
               text{});
    v.optional("member", c.member, "This process among those of the same gateway; empty: the host's name", text{0, 64});
    v.optional("longest_silence_ms", c.longest_silence, "Unchanged registers are published again after this time",
               range{10, 3'600'000});
    v.optional("status_silence_ms", c.status_silence,
               "The status of ports and devices is published again after this time; counters at most once a second",
               range{1000, 3'600'000});
    v.optional("topics", c.topics, "QoS of each topic, within what is safe");
    v.optional("blocks", c.blocks, "Devices of a PLC that are published as well, whoever writes them");
}

}  // namespace plcgw::config
