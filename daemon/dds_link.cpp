#include "daemon/dds_link.hpp"

#include "bridge/dds/log.hpp"
#include "daemon/line_events.hpp"
#include "daemon/log.hpp"
#include "daemon/read_before.hpp"
#include "daemon/version.hpp"

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/post.hpp>

#include <utility>

namespace plcgw {
namespace {

void log_line(dds_log_level level, const std::string& line)
{
    if (level == dds_log_level::info)
        log::info("DDS: {}", line);
    else
        log::warning("DDS: {}", line);
}

}  // namespace

dds_link::dds_link(boost::asio::io_context& loop, const gateway_config& config, std::string config_hash)
    : settings_(config.dds.settings), identity_{config.gateway,
                                                config.dds.member.empty() ? boost::asio::ip::host_name()
                                                                          : config.dds.member,
                                                version, std::move(config_hash)}
{
    port_.port = "dds";
    port_.state = settings_.enabled ? link_state::starting : link_state::disabled;
    port_.since = wall_now();
    if (config.standby.is_configured())
        shared_lease_ = config.standby.lease;
    if (!settings_.enabled)
        return;
    set_event_sink([this](const line_event& event) {
        if (publisher_)
            publisher_->publish(event, wall_now());
    });
    set_dds_log([&loop](dds_log_level level, const std::string& line) {  // on Cyclone's threads
        boost::asio::post(loop, [level, line] { log_line(level, line); });
    });
}

dds_link::~dds_link()
{
    set_event_sink({});
    set_dds_log({});
}

void dds_link::assert_liveliness()
{
    if (publisher_ && shared_lease_)
        publisher_->assert_liveliness();
}

void dds_link::set_strength(std::int32_t strength)
{
    strength_ = strength;
    if (publisher_ && shared_lease_)
        publisher_->set_strength(strength);
}

bool dds_link::open()
{
    if (!settings_.enabled)
        return false;
    if (publisher_)
        look_at_addresses();
    if (publisher_) {
        look_at_publisher();
        return false;
    }
    address_set addresses = addresses_of(watched_interface());
    auto made = dds_publisher::create(settings_, identity_, shared_lease_);
    if (!made) {
        show(link_state::down, made.error().text);
        if (!std::exchange(failed_, true))
            say(line_event::severity::warning, "dds.failed", "dds", "DDS: {}. It is tried again until it works",
                made.error().text);
        return false;
    }
    failed_ = false;
    publisher_.emplace(std::move(*made));
    set_strength(strength_);
    addresses_.start(std::move(addresses));
    if (std::exchange(was_open_, true))
        ++port_.reopens;
    show(link_state::up, {});
    say(line_event::severity::info, "dds.open", "dds", "DDS publishes on domain {}, {}", settings_.domain,
        !settings_.cyclone_config.empty() ? "as " + settings_.cyclone_config + " says"
        : settings_.interface.empty()     ? "interface of Cyclone's choice"
                                          : "interface " + settings_.interface);
    return true;
}

// What the file of a site says of interfaces is not known here: then any address may be the one.
std::string dds_link::watched_interface() const
{
    return settings_.cyclone_config.empty() ? settings_.interface : std::string();
}

void dds_link::close()
{
    look_at_publisher();
    published_before_ += publisher_->published();
    drops_before_ += publisher_->drops();
    for (const auto& close_part : parts_)
        close_part();
    publisher_.reset();
}

void dds_link::look_at_addresses()
{
    if (!addresses_.look(addresses_of(watched_interface())))
        return;
    say(line_event::severity::warning, "dds.moved", "dds",
        "DDS: the address of {} has changed, which leaves a domain deaf: it is made anew, everything is published "
        "again",
        settings_.interface.empty() ? "an interface" : settings_.interface);
    close();
    show(link_state::down, "the address has changed");
}

void dds_link::look_at_publisher()
{
    constexpr unsigned pause = 60;  // seconds between complaints about drops
    port_.tx_frames = published_before_ + publisher_->published();
    port_.errors = drops_before_ + publisher_->drops();
    ++seconds_since_drops_;
    if (port_.errors != drops_said_) {
        port_.detail = publisher_->last_error();
        if (drops_said_ == 0 || seconds_since_drops_ >= pause) {
            say(line_event::severity::warning, "dds.drops", "dds",
                "DDS: {} samples could not be written, {} since the start: {}", port_.errors - drops_said_,
                port_.errors, port_.detail);
            drops_said_ = port_.errors;
            seconds_since_drops_ = 0;
        }
    }
    for (const std::string& each : publisher_->take_refusals())
        say(line_event::severity::warning, "dds.incompatible", "dds", "DDS: {}, and gets nothing", each);
}

void dds_link::show(link_state state, std::string detail)
{
    if (std::exchange(port_.state, state) != state)
        port_.since = wall_now();
    port_.detail = std::move(detail);
}

}  // namespace plcgw
