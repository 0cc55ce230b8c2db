#include "daemon/gateway.hpp"

#include "daemon/control_command.hpp"
#include "daemon/control_path.hpp"
#include "daemon/line_events.hpp"
#include "daemon/log.hpp"
#include "daemon/pair_command.hpp"
#include "daemon/scan/scan_command.hpp"
#include "daemon/service_notify.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
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

}  // namespace

gateway::gateway(asio::io_context& loop, const config::loaded& from)
    : loop_(loop), config_(from.config), started_(wall_now()), learned_(loop, config_.state.folder),
      fp7_ports_(loop, [this] { settle_memory(); }), upstream_(loop, [this] { settle_memory(); }),
      through_(loop.get_executor()), dds_(loop, config_, from.hash), blocks_(lines_, message_lines_, dds_),
      points_(loop, dds_), statuses_(dds_, config_.dds.status_silence),
      writes_(loop.get_executor(), {config_, plcs_, lines_, message_lines_, blocks_, points_, through_},
              [this] { settle_memory(); }),
      access_(config_, plcs_, lines_, points_, writes_, [this] { return is_active(); }),
      commands_(
          loop, config_.dds, dds_.identity(),
          [this](order what) { return writes_.carry_out(std::move(what), order_origin::dds); },
          [this] { return is_active(); }),
      second_(loop), watchdog_(loop)
{
    make_plcs(from.folder);
    make_lines();
    make_programs(from.folder);
    make_servers();
    make_blocks();
    make_plc_links();
    make_copies();
    make_points();
    make_statuses();
    make_standby();
    dds_.add_part([this] { commands_.close(); });
    learned_.remember(lines_);
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
    upstream_.start();
    points_.start();
    if (standby_)
        standby_->start();
    asio::co_spawn(loop_, every_second(), asio::detached);
    if (const auto period = service::watchdog_period())
        asio::co_spawn(loop_, keep_watchdog(*period), asio::detached);
    service::ready();
    return true;
}

bool gateway::listen()
{
    if (standby_)
        return true;  // when it is active
    return std::all_of(servers_.begin(), servers_.end(), [this](const auto& server) { return listen(*server); });
}

bool gateway::listen(tcp_server& server)
{
    const std::string& port = server.port().port;
    if (const auto ec = server.listen()) {
        plcgw::say(line_event::severity::error, "listener.failed", port, "MODBUS TCP cannot listen on {}: {}. {}",
                   server.endpoint(), ec.message(), cure_of(ec));
        return false;
    }
    plcgw::say(line_event::severity::info, "listener.open", port, "MODBUS TCP listens on {}", server.endpoint());
    asio::co_spawn(loop_, server.accept_clients(), asio::detached);
    return true;
}

// Without it the gateway does its work all the same.
void gateway::start_control()
{
    control_.emplace(loop_, control_socket(config_.control.socket),
                     [this](nlohmann::json what) { return command(std::move(what)); });
    if (const auto ec = control_->listen())
        log::warning("commands: cannot listen on {}: {}", control_->path().string(), ec.message());
    else
        asio::co_spawn(loop_, control_->accept_clients(), asio::detached);
}

asio::awaitable<nlohmann::json> gateway::command(nlohmann::json what)
{
    if (access_commands::knows(what)) {
        auto reply = co_await access_.answer(std::move(what));
        co_return std::move(reply);
    }
    if (what.value("command", "") == "scan")
        co_return scan_command(lines_, what, is_active(), now());
    if (what.value("command", "") == "pair")
        co_return pair_command(standby_.get(), what);
    nlohmann::json reply = control_command(plcs_, links_.get(), what, now());
    settle_memory();
    co_return reply;
}

void gateway::publish_everything()
{
    blocks_.say_everything();
    blocks_.publish();
    points_.say_everything();
    points_.publish();
    for (const auto& line : lines_) {
        line->routes.say_everything();
        for (const sample& each : line->routes.take_samples(now()))
            dds_.publish(each);
    }
    for (const auto& line : message_lines_) {
        line->content.say_everything();
        say(line->content.take_samples(now()));
    }
    statuses_.say_everything();
}

asio::awaitable<void> gateway::every_second()
{
    for (;;) {
        if (dds_.open())
            publish_everything();
        if (dds_.is_open())
            commands_.keep_open();
        if (is_active())
            for (const auto& line : lines_)
                line->statuses.show(wall_now());
        listen_again();
        settle_memory();
        blocks_.keep_silences(now(), config_.dds.longest_silence);
        blocks_.publish();
        points_.keep_silences();
        points_.publish();
        while (statuses_.look(now(), wall_now()))
            co_await asio::post(loop_, asio::use_awaitable);
        show_status();
        second_.expires_after(status_period);
        co_await second_.async_wait(no_throw);
    }
}

void gateway::show_status()
{
    gateway_status status;
    status.started = started_;
    if (standby_) {
        status.role = standby_->role();
        status.strength = standby_->strength();
    }
    for (const auto& line : lines_) {
        status.routes_up += static_cast<std::uint32_t>(line->routes.routes_up());
        status.routes_total += static_cast<std::uint32_t>(line->routes.routes_total());
    }
    for (const auto& line : message_lines_) {
        status.routes_up += static_cast<std::uint32_t>(line->content.routes_up());
        status.routes_total += static_cast<std::uint32_t>(line->content.routes_total());
    }
    dds_.publish(status);
    std::string text = fmt::format("{} of {} routes up", status.routes_up, status.routes_total);
    if (standby_)
        text = fmt::format("{}, {}", to_string(status.role), text);
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
