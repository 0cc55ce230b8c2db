#include "daemon/gateway.hpp"

#include "bridge/dds/log.hpp"
#include "daemon/config/program_file.hpp"
#include "daemon/log.hpp"
#include "daemon/service_notify.hpp"
#include "daemon/version.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>

namespace plcgw {
namespace {

constexpr std::chrono::seconds status_period{1};

modbus::rtu_timing timing_of(const line_config& line, const station_config& station)
{
    return {.format = {line.baud_rate, line.data_bits, line.check, line.stop_bits},
            .response_timeout = station.response_timeout.value_or(line.response_timeout),
            .retries = station.retries.value_or(line.retries),
            .turnaround = line.turnaround_delay,
            .gap = line.gap,
            .silence = line.silence};
}

std::vector<station> stations_of(const gateway_config& c, const line_config& line)
{
    std::vector<station> stations;
    for (const station_config& each : c.stations)
        if (each.line == line.name)
            stations.push_back(
                {each.name, modbus::unit_id{static_cast<std::uint8_t>(each.unit)}, timing_of(line, each)});
    return stations;
}

void log_event(const line_event& event)
{
    if (event.level == line_event::severity::warning)
        log::warning("{}", event.text);
    else
        log::info("{}", event.text);
}

void log_dds(dds_log_level level, const std::string& line)
{
    if (level == dds_log_level::info)
        log::info("DDS: {}", line);
    else
        log::warning("DDS: {}", line);
}

}  // namespace

gateway::running_line::running_line(asio::io_context& loop, const line_config& c, std::vector<station> stations,
                                    gateway& owner)
    : routes(c.name, std::move(stations), owner.config_.dds.longest_silence),
      driver(loop, c, routes, [this, &owner] { owner.settle(*this); })
{
}

gateway::gateway(asio::io_context& loop, const config::loaded& from)
    : loop_(loop), config_(from.config), folder_(from.folder), config_hash_(from.hash), started_(wall_now()),
      second_(loop), watchdog_(loop)
{
    make_plcs();
    make_lines(loop);
    make_servers(loop);
    make_blocks();
}

gateway::~gateway() { set_dds_log({}); }

void gateway::make_plcs()
{
    for (const plc_config& each : config_.plcs) {
        const std::string program = config::program_text(each, folder_).value_or("");
        plcs_.push_back(std::make_unique<plc::simulated_plc>(each.name, *plc::find_model(each.model),
                                                             plc::parse_setup_program(program)));
        if (const auto& fault = plcs_.back()->fault())
            log::warning("PLC {}: error 202, detail {}: {}", each.name, fault->detail, fault->reason);
    }
}

plc::simulated_plc* gateway::find_plc(const std::string& name)
{
    const auto found = std::find_if(plcs_.begin(), plcs_.end(), [&](const auto& each) { return each->name() == name; });
    return found == plcs_.end() ? nullptr : found->get();
}

void gateway::make_lines(asio::io_context& loop)
{
    for (const line_config& each : config_.lines) {
        lines_.push_back(std::make_unique<running_line>(loop, each, stations_of(config_, each), *this));
        add_routes(lines_.size() - 1);
    }
}

void gateway::add_routes(std::size_t line_index)
{
    std::vector<std::string> stations;
    for (const station_config& each : config_.stations)
        if (each.line == config_.lines[line_index].name)
            stations.push_back(each.name);

    for (const route_config& each : config_.routes) {
        const auto station = std::find(stations.begin(), stations.end(), each.station);
        if (station == stations.end())
            continue;
        route r;
        r.name = each.name;
        r.plc = find_plc(each.plc);
        r.at = *r.plc->memory().find(*plc::parse_device(each.device));
        r.table = each.table;
        r.first = modbus::address{static_cast<std::uint16_t>(each.first)};
        r.count = static_cast<std::uint16_t>(each.count);
        r.way = each.way;
        lines_[line_index]->routes.add_route(std::move(r), static_cast<std::size_t>(station - stations.begin()),
                                             each.period);
    }
}

void gateway::make_servers(asio::io_context& loop)
{
    for (const tcp_server_config& each : config_.modbus_tcp) {
        unit_table units;
        units.fill(find_plc(each.other_units));
        for (const unit_config& unit : each.units)
            units[unit.unit] = find_plc(unit.plc);
        servers_.push_back(std::make_unique<tcp_server>(loop, each, units, [this] { settle_memory(); }));
    }
}

void gateway::make_blocks()
{
    for (const block_config& each : config_.dds.blocks) {
        plc_block block;
        block.plc = find_plc(each.plc);
        block.head = *plc::parse_device(each.device);
        block.at = *block.plc->memory().find(block.head);
        block.count = each.count;
        block.name = each.plc + "." + plc::to_string(block.head);
        blocks_.push_back({std::move(block), true});
    }
}

bool gateway::start()
{
    for (const auto& server : servers_) {
        if (const auto ec = server->listen()) {
            log::error("MODBUS TCP cannot listen on {}: {}. `ss -ltnp` shows who does", server->endpoint(),
                       ec.message());
            return false;
        }
        log::info("MODBUS TCP listens on {}", server->endpoint());
        asio::co_spawn(loop_, server->accept_clients(), asio::detached);
    }
    for (const auto& line : lines_)
        asio::co_spawn(loop_, line->driver.run(), asio::detached);
    if (config_.dds.settings.enabled) {
        set_dds_log([&loop = loop_](dds_log_level level, const std::string& line) {
            asio::post(loop, [level, line] { log_dds(level, line); });
        });
        open_dds();
    }
    asio::co_spawn(loop_, keep_dds(), asio::detached);
    if (const auto period = service::watchdog_period())
        asio::co_spawn(loop_, keep_watchdog(*period), asio::detached);
    service::ready();
    return true;
}

void gateway::settle(running_line& line)
{
    for (const line_event& event : line.routes.take_events())
        log_event(event);
    settle_memory();
    for (const sample& each : line.routes.take_samples(now()))
        if (publisher_)
            publisher_->publish(each);
}

void gateway::settle_memory()
{
    for (const auto& plc : plcs_) {
        for (const plc::change& changed : plc->memory().take_changes()) {
            for (const auto& line : lines_)
                if (line->routes.memory_changed(*plc, changed))
                    line->driver.wake();
            for (running_block& block : blocks_)
                block.changed = block.changed || touches(block.content, *plc, changed);
        }
    }
    publish_blocks();
}

void gateway::publish_blocks()
{
    if (!publisher_)
        return;
    for (running_block& block : blocks_)
        if (std::exchange(block.changed, false))
            publisher_->publish(sample_of(block.content, wall_now()));
}

void gateway::publish_everything()
{
    for (running_block& block : blocks_)
        block.changed = true;
    publish_blocks();
    for (const auto& line : lines_) {
        line->routes.say_everything();
        for (const sample& each : line->routes.take_samples(now()))
            publisher_->publish(each);
    }
}

bool gateway::open_dds()
{
    const std::string member = config_.dds.member.empty() ? asio::ip::host_name() : config_.dds.member;
    auto made = dds_publisher::create(config_.dds.settings, {config_.gateway, member, version, config_hash_});
    if (!made) {
        if (!std::exchange(dds_failed_, true))
            log::warning("DDS: {}. It is tried again until it works", made.error().text);
        return false;
    }
    dds_failed_ = false;
    publisher_.emplace(std::move(*made));
    log::info("DDS publishes on domain {}, interface {}", config_.dds.settings.domain,
              config_.dds.settings.interface.empty() ? "of Cyclone's choice" : config_.dds.settings.interface);
    publish_everything();
    return true;
}

asio::awaitable<void> gateway::keep_dds()
{
    for (;;) {
        if (config_.dds.settings.enabled && !publisher_)
            open_dds();
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
    if (publisher_)
        publisher_->publish(status);
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
