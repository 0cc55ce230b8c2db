#include "daemon/gateway.hpp"

#include "daemon/config/program_file.hpp"
#include "daemon/control_command.hpp"
#include "daemon/control_path.hpp"
#include "daemon/log.hpp"
#include "daemon/service_notify.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw {
namespace {

constexpr std::chrono::seconds status_period{1};

std::string_view cure_of(boost::system::error_code ec)
{
    if (ec == boost::system::errc::permission_denied)
        return "Ports below 1024 need CAP_NET_BIND_SERVICE, which the systemd unit gives, or choose another port";
    if (ec == boost::system::errc::address_not_available)
        return "No interface of this host has that address now";
    return "`ss -ltnp` shows who uses the port";
}

void log_event(const line_event& event)
{
    if (event.level == line_event::severity::warning)
        log::warning("{}", event.text);
    else
        log::info("{}", event.text);
}

}  // namespace

gateway::gateway(asio::io_context& loop, const config::loaded& from)
    : loop_(loop), config_(from.config), started_(wall_now()), fp7_ports_(loop, [this] { settle_memory(); }),
      dds_(loop, config_, from.hash), second_(loop), watchdog_(loop)
{
    make_plcs(from.folder);
    make_lines();
    make_programs(from.folder);
    make_servers();
    make_blocks();
    make_plc_links();
}

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
        if (each.role == line_role::server) {
            server_lines_.push_back(make_server_line(loop_, each, plc, fp7_ports_, [this] { settle_memory(); }));
            continue;
        }
        const std::size_t index = lines_.size();
        lines_.push_back(
            std::make_unique<running_line>(loop_, config_, each, plc, [this, index] { settle(*lines_[index]); }));
    }
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
            running_line& line = *find_line(channel.line);
            find_plc(each.name)->attach(channel.channel, shown_line(line.config, plc::role::client, 0));
            programs_.push_back(std::make_unique<plc_program>(
                loop_, plc::adprw_runner(plc::parse_adprw_program(text), *find_plc(each.name), channel.channel),
                line.gate, timing_of(line.config), [this] { settle_memory(); }));
        }
    }
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
        servers_.push_back(std::make_unique<tcp_server>(loop_, each, units, [this] { settle_memory(); }));
    }
}

void gateway::make_blocks()
{
    for (const block_config& each : config_.dds.blocks) {
        plc_block block;
        block.plc = find_plc(each.plc);
        block.head = *plc::parse_device(each.device, block.plc->model().names);
        block.at = *block.plc->memory().find(block.head);
        block.count = each.count;
        block.name = each.plc + "." + plc::to_string(block.head, block.plc->model().names);
        blocks_.push_back({std::move(block), true});
    }
}

void gateway::make_plc_links()
{
    if (config_.plc_links.empty())
        return;
    links_ = std::make_unique<plc_links>(loop_, config_, started_, [this] { settle_memory(); });
    for (const plc_link_config& each : config_.plc_links)
        links_->add(each, *find_plc(each.plc), fp7_ports_);
}

bool gateway::start()
{
    if (!listen())
        return false;
    start_control();
    for (const auto& line : lines_)
        asio::co_spawn(loop_, line->driver->run(), asio::detached);
    for (const auto& line : server_lines_)
        asio::co_spawn(loop_, line->run(), asio::detached);
    for (const auto& line : message_lines_)
        asio::co_spawn(loop_, line->run(), asio::detached);
    for (const auto& program : programs_)
        asio::co_spawn(loop_, program->run(), asio::detached);
    if (links_)
        links_->start();
    asio::co_spawn(loop_, every_second(), asio::detached);
    if (const auto period = service::watchdog_period())
        asio::co_spawn(loop_, keep_watchdog(*period), asio::detached);
    service::ready();
    return true;
}

bool gateway::listen()
{
    for (const auto& server : servers_) {
        if (const auto ec = server->listen()) {
            log::error("MODBUS TCP cannot listen on {}: {}. {}", server->endpoint(), ec.message(), cure_of(ec));
            return false;
        }
        log::info("MODBUS TCP listens on {}", server->endpoint());
        asio::co_spawn(loop_, server->accept_clients(), asio::detached);
    }
    return true;
}

// Without it the gateway does its work all the same.
void gateway::start_control()
{
    control_.emplace(loop_, control_socket(config_.control.socket),
                     [this](const nlohmann::json& what) { return command(what); });
    if (const auto ec = control_->listen())
        log::warning("commands: cannot listen on {}: {}", control_->path().string(), ec.message());
    else
        asio::co_spawn(loop_, control_->accept_clients(), asio::detached);
}

nlohmann::json gateway::command(const nlohmann::json& what)
{
    nlohmann::json reply = control_command(plcs_, links_.get(), what, now());
    settle_memory();
    return reply;
}

void gateway::settle(running_line& line)
{
    for (const line_event& event : line.routes.take_events())
        log_event(event);
    line.gate.deliver();
    settle_memory();
    say(line.routes.take_samples(now()));
}

void gateway::settle(message_line& line)
{
    settle_memory();
    const std::vector<sample> samples = line.content.take_samples(now());
    for (const line_event& event : line.content.take_events())
        log_event(event);
    for (const serial_message& each : line.content.take_messages())
        dds_.publish(each);
    say(samples);
}

void gateway::say(const std::vector<sample>& samples)
{
    for (const sample& each : samples)
        dds_.publish(each);
    if (samples.empty())
        return;
    for (running_block& block : blocks_)  // a route's quality is that of the block over its devices, too
        block.changed = block.changed || sample_now(block).state != block.said;
    publish_blocks();
}

void gateway::settle_memory()
{
    fp7_ports_.look();
    const bool changed_any =
        std::any_of(plcs_.begin(), plcs_.end(), [](const auto& plc) { return plc->memory().has_changes(); });
    for (const auto& plc : plcs_) {
        for (const plc::change& changed : plc->memory().take_changes()) {
            for (const auto& line : lines_)
                if (line->routes.memory_changed(*plc, changed))
                    line->driver->wake();
            for (const auto& line : message_lines_)
                if (line->content.memory_changed(*plc, changed, now()))
                    line->wake();
            for (running_block& block : blocks_)
                block.changed = block.changed || touches(block.content, *plc, changed);
            if (links_)
                links_->memory_changed(*plc, changed);
        }
    }
    if (!changed_any)
        return;
    if (links_)
        links_->send();
    for (const auto& program : programs_)
        program->look();
    publish_blocks();
}

void gateway::publish_blocks()
{
    if (!dds_.is_open())
        return;
    for (running_block& block : blocks_) {
        if (!std::exchange(block.changed, false))
            continue;
        const sample now_in_it = sample_now(block);
        block.said = now_in_it.state;
        dds_.publish(now_in_it);
    }
}

sample gateway::sample_now(const running_block& block) const
{
    sample made = sample_of(block.content, wall_now());
    for (const auto& line : lines_)
        line->routes.worsen(made, *block.content.plc, block.content.at, bits_of(block.content));
    for (const auto& line : message_lines_)
        line->content.worsen(made, *block.content.plc, block.content.at, bits_of(block.content));
    return made;
}

void gateway::publish_everything()
{
    for (running_block& block : blocks_)
        block.changed = true;
    publish_blocks();
    for (const auto& line : lines_) {
        line->routes.say_everything();
        for (const sample& each : line->routes.take_samples(now()))
            dds_.publish(each);
    }
    for (const auto& line : message_lines_) {
        line->content.say_everything();
        say(line->content.take_samples(now()));
    }
}

asio::awaitable<void> gateway::every_second()
{
    for (;;) {
        if (dds_.open())
            publish_everything();
        show_status();
        second_.expires_after(status_period);
        co_await second_.async_wait(no_throw);
    }
}

void gateway::show_status()
{
    gateway_status status;
    status.started = started_;
    for (const auto& line : lines_) {
        status.routes_up += static_cast<std::uint32_t>(line->routes.routes_up());
        status.routes_total += static_cast<std::uint32_t>(line->routes.routes_total());
    }
    for (const auto& line : message_lines_) {
        status.routes_up += static_cast<std::uint32_t>(line->content.routes_up());
        status.routes_total += static_cast<std::uint32_t>(line->content.routes_total());
    }
    dds_.publish(status);
    const std::string text = fmt::format("{} of {} routes up", status.routes_up, status.routes_total);
    if (text != shown_status_)
        service::status(shown_status_ = text);
}

asio::awaitable<void> gateway::keep_watchdog(std::chrono::microseconds period)
{
    for (;;) {
        service::feed_watchdog();
        watchdog_.expires_after(period);
        co_await watchdog_.async_wait(no_throw);
    }
}

}  // namespace plcgw
