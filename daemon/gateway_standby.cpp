// A gateway that is a member of a pair: what begins when it becomes active, and ends when it is not any more.
#include "daemon/gateway.hpp"
#include "daemon/log.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include <algorithm>

namespace plcgw {

void gateway::make_standby()
{
    if (!config_.standby.is_configured())
        return;
    standby_member::work work{[this] { commands_.take_as_standby(); }, [this] { begin_work(); },
                              [this] { publish_everything(); }, [this] { end_work(); }, [this] { settle_memory(); }};
    standby_ = std::make_unique<standby_member>(loop_, config_, started_, plcs_, lines_, dds_, std::move(work));
    dds_.add_part([this] { standby_->renew_dds(); });
    line_voice& answers = standby_->answers();
    for (const auto& each : server_lines_)
        each->obey(answers);
    for (const auto& each : message_lines_)
        each->obey(answers);
    for (const auto& each : programs_)
        each->obey(answers);
    for (const auto& each : servers_)
        each->obey(answers);
    if (links_)
        links_->obey(answers);
    upstream_.obey(answers);
}

void gateway::begin_work()
{
    for (const auto& each : servers_)
        listen(*each);
    publish_everything();
    show_status();
}

void gateway::end_work()
{
    for (const auto& each : lines_)
        each->routes.end_scan();
    for (const auto& each : servers_)
        each->stop();
    for (const auto& each : server_lines_)
        each->wake();
    for (const auto& each : message_lines_)
        each->wake();
    show_status();
}

// The address may come to this host a little later than the role, or another process has the port: said each time that
// something else is wrong.
void gateway::listen_again()
{
    if (!standby_ || !standby_->is_active())
        return;
    for (const auto& each : servers_)
        if (!each->listens())
            listen(*each);
}

void gateway::leave()
{
    if (standby_)
        standby_->leave();
    learned_.keep(lines_);  // with the times that were measured
}

}  // namespace plcgw
