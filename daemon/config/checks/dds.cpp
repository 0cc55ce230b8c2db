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

}  // namespace

void check_dds(check_context& c)
{
    check_peers(c);
    check_partitions(c);
    check_cyclone_config(c);
    check_deadlines(c);
    check_blocks(c);
}

}  // namespace plcgw::config
