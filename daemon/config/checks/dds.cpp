#include "daemon/config/checks/checks.hpp"
#include "daemon/config/fields.hpp"
#include "daemon/config/ip_address.hpp"

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
    check_blocks(c);
    check_writes(c);
}

}  // namespace plcgw::config
