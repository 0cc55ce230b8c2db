#include "daemon/config/checks/checks.hpp"
#include "daemon/config/fields.hpp"
#include "daemon/config/ip_address.hpp"

#include <algorithm>
#include <filesystem>

namespace plcgw::config {
namespace {

// As daemon/gateway.cpp calls it in DDS: "main.D0".
std::string block_name(const std::string& plc, const plc::model& model, plc::device head)
{
    return plc + "." + plc::to_string(head, model.names);
}

// Cyclone runs on IPv4 here; it would look up a name while the gateway waits.
void check_peers(check_context& c)
{
    for (std::size_t i = 0; i < c.config.dds.settings.peers.size(); ++i) {
        const std::string& peer = c.config.dds.settings.peers[i];
        const auto address = ip_address(peer);
        if (!peer.empty() && (!address || !address->is_v4()))
            c.complain("/dds/peers/" + std::to_string(i),
                       "is \"" + peer + "\", expected an IPv4 address such as 192.168.1.5, not a name");
    }
}

// A writer is in a partition; a reader may look into all that fit a pattern.
void check_partition(check_context& c, const std::string& at, const std::string& name)
{
    if (name.find_first_of("*?[") != std::string::npos)
        c.complain(at, "is \"" + name + "\": a pattern is for readers (`plc-gateway watch --partition '" + name +
                           "'`), the gateway publishes in partitions that have names");
}

void check_partitions(check_context& c)
{
    const dds_settings& s = c.config.dds.settings;
    check_partition(c, "/dds/partition", s.partition);
    for (std::size_t i = 0; i < s.partitions.size(); ++i)
        check_partition(c, "/dds/partitions/" + std::to_string(i), s.partitions[i]);
}

void check_cyclone_config(check_context& c)
{
    const dds_settings& s = c.config.dds.settings;
    if (s.cyclone_config.empty())
        return;
    const std::string at = "/dds/cyclone_config";
    if (!std::filesystem::is_regular_file(s.cyclone_config))
        c.complain(at, "is \"" + s.cyclone_config +
                           "\", which cannot be found: a path is relative to the folder of this configuration");
    else if (!s.peers.empty())
        c.complain("/dds/peers", "are not used: " + at + " says all of where the gateway is heard, its peers, too",
                   mistake::weight::warning);
}

// A deadline is a promise: readers are told when no sample came within it.
void check_deadlines(check_context& c)
{
    const dds_config& dds = c.config.dds;
    const auto look = [&](const char* key, const topic_settings& topic, milliseconds silence, const char* setting) {
        const milliseconds least = silence + milliseconds(1);
        if (topic.deadline.count() != 0 && topic.deadline < least)
            c.complain(std::string("/dds/topics/") + key + "/deadline_ms",
                       "is " + std::to_string(topic.deadline.count()) + ", but an unchanged sample comes again after " +
                           std::to_string(silence.count()) + " ms (" + setting + ") only: at least " +
                           std::to_string(least.count()));
    };
    constexpr milliseconds status_period{1000};
    milliseconds slowest_read = dds.longest_silence;
    for (const route_config& each : c.config.routes)
        if (reads(each.way) && !each.station.empty())
            slowest_read = std::max(slowest_read, each.period);
    look("register_block", dds.topics.register_block, slowest_read, "longest_silence_ms, or period_ms of a route");
    milliseconds slowest_point{};
    for (const point_config& each : c.config.points) {
        if (each.longest_silence.count() == 0 && dds.topics.point.deadline.count() != 0)
            c.complain("/dds/topics/point/deadline_ms", "cannot be kept: point " + each.name +
                                                            " has longest_silence_ms 0, so that it comes only when it "
                                                            "changes");
        slowest_point = std::max(slowest_point, each.longest_silence);
    }
    look("point", dds.topics.point, slowest_point, "longest_silence_ms of a point");
    look("port_status", dds.topics.port_status, dds.status_silence, "status_silence_ms");
    look("device_status", dds.topics.device_status, dds.status_silence, "status_silence_ms");
    look("gateway_status", dds.topics.gateway_status, status_period, "its period");
}

void check_blocks(check_context& c)
{
    device_check devices(c);
    std::set<std::string> seen;
    for (std::size_t i = 0; i < c.config.dds.blocks.size(); ++i) {
        const block_config& b = c.config.dds.blocks[i];
        const std::string row = "/dds/blocks/" + std::to_string(i);
        const plc::model* const model = c.model_of(b.plc);
        const auto device = model == nullptr ? std::nullopt : plc::parse_device(b.device, model->names);
        const bool bits = device && plc::is_bit_kind(device->kind);
        const std::size_t size = bits ? b.count : std::size_t{16} * b.count;
        if (!devices.place_of(row, b.plc, b.device, c.is_sound(row) ? size : 1))
            continue;
        const std::string name = block_name(b.plc, *model, *device);
        if (name.size() > name_rule.most)
            c.complain(row + "/plc", "makes \"" + name + "\", which is longer than the " +
                                         std::to_string(name_rule.most) +
                                         " bytes of a DDS name: shorten the PLC's name");
        else if (!seen.insert(name).second)
            c.complain(row + "/device", "makes \"" + name + "\" a second time: raise the count of the first one");
    }
}

// Routes, messages and blocks are instances of one topic: a name that two of them have would be of one instance.
class sample_names {
public:
    explicit sample_names(check_context& c) : c_(c) {}

    // row: of the name, whose mistakes are said before.
    void take(const std::string& row, const std::string& at, const std::string& name, std::string who)
    {
        if (!c_.is_sound(row))
            return;
        const auto [found, is_new] = taken_.emplace(name, who);
        if (!is_new && found->second != who)
            c_.complain(at, "makes \"" + name + "\", the name of a " + found->second + " in DDS: rename one of them");
    }

private:
    check_context& c_;
    std::map<std::string, std::string> taken_;  // name: what it is of; lists that know their doubles say them
};

void check_names_of_messages(check_context& c, sample_names& names)
{
    for (std::size_t i = 0; i < c.config.lines.size(); ++i) {
        const general_purpose_config& g = c.config.lines[i].messages;
        const std::string at = item("lines", i, "general_purpose");
        for (std::size_t n = 0; n < g.received.size(); ++n) {
            const std::string row = at + "/received/" + std::to_string(n);
            names.take(row, row + "/name", g.received[n].name, "received message");
        }
        for (std::size_t n = 0; n < g.messages.size(); ++n)
            for (std::size_t f = 0; f < g.messages[n].fields.size(); ++f) {
                const std::string row = at + "/messages/" + std::to_string(n);
                names.take(row, row + "/fields/" + std::to_string(f) + "/name",
                           g.messages[n].name + "." + g.messages[n].fields[f].name, "field of a message");
            }
    }
}

void check_names(check_context& c)
{
    sample_names names(c);
    for (std::size_t i = 0; i < c.config.routes.size(); ++i)
        names.take(item("routes", i), item("routes", i, "name"), c.config.routes[i].name, "route");
    check_names_of_messages(c, names);
    for (std::size_t i = 0; i < c.config.dds.blocks.size(); ++i) {
        const block_config& b = c.config.dds.blocks[i];
        const plc::model* const model = c.model_of(b.plc);
        if (const auto head = model == nullptr ? std::nullopt : plc::parse_device(b.device, model->names))
            names.take("/dds/blocks/" + std::to_string(i), "/dds/blocks/" + std::to_string(i) + "/device",
                       block_name(b.plc, *model, *head), "block");
    }
}

// Allowed for one, but not at all.
void check_writes(check_context& c)
{
    const auto idle = [&](const std::string& at) {
        c.complain(at, "is true, but allows nothing while /dds/writes is false", mistake::weight::warning);
    };
    for (std::size_t i = 0; !c.config.dds.writes && i < c.config.dds.blocks.size(); ++i)
        if (c.config.dds.blocks[i].writable)
            idle("/dds/blocks/" + std::to_string(i) + "/writable");
    for (std::size_t i = 0; !c.config.dds.writes && i < c.config.lines.size(); ++i)
        if (c.config.lines[i].messages.dds_sends)
            idle(item("lines", i) + "/general_purpose/dds_sends");
}

}  // namespace

void check_dds(check_context& c)
{
    check_peers(c);
    check_partitions(c);
    check_cyclone_config(c);
    check_deadlines(c);
    check_blocks(c);
    check_names(c);
    check_writes(c);
}

}  // namespace plcgw::config
