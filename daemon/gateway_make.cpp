// What a gateway is made of, from its configuration: PLCs, lines, servers, and who is shown by what.
#include "daemon/config/program_file.hpp"
#include "daemon/gateway.hpp"
#include "daemon/log.hpp"

#include <algorithm>

namespace plcgw {

void gateway::make_plcs(const std::string& folder)
{
    for (const plc_config& each : config_.plcs) {
        const std::string program = config::program_text(each, folder).value_or("");
        plcs_.push_back(std::make_unique<plc::simulated_plc>(each.name, *plc::find_model(each.model),
                                                             plc::parse_setup_program(program)));
        for (const plc::setup_fault& fault : plcs_.back()->faults())
            log::warning("PLC {}: error {} on channel {}, detail {}: {}", each.name, static_cast<unsigned>(fault.code),
                         fault.channel, fault.what.detail, fault.what.reason);
    }
}

plc::simulated_plc* gateway::find_plc(const std::string& name)
{
    const auto found = std::find_if(plcs_.begin(), plcs_.end(), [&](const auto& each) { return each->name() == name; });
    return found == plcs_.end() ? nullptr : found->get();
}

running_line* gateway::find_line(const std::string& name)
{
    const auto found =
        std::find_if(lines_.begin(), lines_.end(), [&](const auto& each) { return each->routes.name() == name; });
    return found == lines_.end() ? nullptr : found->get();
}

void gateway::make_lines()
{
    const auto plc = [this](const std::string& name) -> plc::simulated_plc& { return *find_plc(name); };
    for (const line_config& each : config_.lines) {
        if (each.protocol == line_protocol::general_purpose) {
            make_message_line(each);
            continue;
        }
        if (each.role == line_role::server)
            continue;
        const std::size_t index = lines_.size();
        lines_.push_back(
            std::make_unique<running_line>(loop_, config_, each, plc, [this, index] { settle(*lines_[index]); }));
        through_.add_line(lines_.back()->routes, *lines_.back()->driver);
    }
    const auto gate = [this](const std::string& name) -> forward_gate& { return find_line(name)->gate; };
    for (const line_config& each : config_.lines)
        if (each.role == line_role::server && each.protocol != line_protocol::general_purpose)
            server_lines_.push_back(
                make_server_line(loop_, each, plc, gate, fp7_ports_, [this] { settle_server_line(); }));
}

void gateway::make_message_line(const line_config& line)
{
    const auto plc = [this](const std::string& name) -> plc::simulated_plc& { return *find_plc(name); };
    const std::size_t index = message_lines_.size();
    message_lines_.push_back(std::make_unique<message_line>(loop_, line,
                                                            line_messages_of(line, config_.dds.longest_silence, plc),
                                                            [this, index] { settle(*message_lines_[index]); }));
}

void gateway::make_programs(const std::string& folder)
{
    for (const plc_config& each : config_.plcs) {
        const std::string text = config::program_text(each, folder).value_or("");
        for (const channel_config& channel : each.channels) {
            if (!find_plc(each.name)->model().programs) {
                open_com_port(*find_plc(each.name), channel);
                continue;
            }
            running_line& line = *find_line(channel.line);
            find_plc(each.name)->attach(channel.channel, shown_line(line.config, plc::role::client, 0));
            programs_.push_back(std::make_unique<plc_program>(
                loop_, plc::adprw_runner(plc::parse_adprw_program(text), *find_plc(each.name), channel.channel),
                line.gate, timing_of(line.config), [this] { settle_memory(); }));
        }
    }
}

void gateway::open_com_port(plc::simulated_plc& plc, const channel_config& port)
{
    const auto config = std::find_if(config_.lines.begin(), config_.lines.end(),
                                     [&](const line_config& each) { return each.name == port.line; });
    const auto messages = std::find_if(message_lines_.begin(), message_lines_.end(),
                                       [&](const auto& each) { return each->content.name() == port.line; });
    line_driver& driver = messages != message_lines_.end() ? **messages : *find_line(port.line)->driver;
    fp7_ports_.open(plc, port.channel, *config, driver);
}

unit_target gateway::target_of(const unit_config& unit)
{
    unit_target to;
    to.plc = find_plc(unit.plc);
    if (running_line* const line = find_line(unit.line))
        to.line = &line->gate;
    to.unit = station_number(unit.line_unit == 0 ? unit.unit : unit.line_unit);
    return to;
}

void gateway::make_servers()
{
    for (const tcp_server_config& each : config_.modbus_tcp) {
        unit_table units;
        for (unsigned unit = 0; unit < units.size(); ++unit)
            units[unit] = target_of({.unit = unit, .plc = each.other_units, .line = each.other_units});
        for (const unit_config& unit : each.units)
            units[unit.unit] = target_of(unit);
        servers_.push_back(std::make_unique<tcp_server>(loop_, each, units, through_, [this] { settle_memory(); }));
    }
}

void gateway::make_blocks()
{
    for (const block_config& each : config_.dds.blocks)
        blocks_.add(each, *find_plc(each.plc));
}

void gateway::make_copies()
{
    const auto plc = [this](const std::string& name) -> plc::simulated_plc& { return *find_plc(name); };
    for (const route_config& each : config_.routes) {
        if (!each.from.plc.empty())
            copies_.add(make_copy(each, plc));
        else if (each.upstream.longest_silence.count() != 0)
            upstream_.add(each, plc);
    }
}

void gateway::make_points()
{
    for (const auto& line : lines_)
        points_.add_sources(line->routes);
    for (const auto& line : message_lines_)
        points_.add_sources(line->content);
    points_.add_sources(copies_);
    for (const point_config& each : config_.points)
        points_.add(each, *find_plc(each.plc));
}

void gateway::make_plc_links()
{
    if (config_.plc_links.empty())
        return;
    links_ = std::make_unique<plc_links>(loop_, config_, started_, [this] { settle_memory(); });
    dds_.add_part([this] { links_->close(); });
    for (const plc_link_config& each : config_.plc_links)
        links_->add(each, *find_plc(each.plc), fp7_ports_);
}

void gateway::make_statuses()
{
    for (const auto& line : lines_) {
        statuses_.add(line->driver->port());
        statuses_.add(line->routes);
    }
    for (const auto& line : server_lines_)
        statuses_.add(line->port());
    for (const auto& line : message_lines_)
        statuses_.add(line->port());
    for (const auto& server : servers_)
        statuses_.add(server->port());
    statuses_.add(dds_.port());
}

}  // namespace plcgw
