#include "daemon/dds_link.hpp"

#include "bridge/dds/log.hpp"
#include "daemon/log.hpp"
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
    if (config.standby.is_configured())
        shared_lease_ = config.standby.lease;
    if (!settings_.enabled)
        return;
    set_dds_log([&loop](dds_log_level level, const std::string& line) {  // on Cyclone's threads
        boost::asio::post(loop, [level, line] { log_line(level, line); });
    });
}

dds_link::~dds_link() { set_dds_log({}); }

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
    if (!settings_.enabled || publisher_)
        return false;
    auto made = dds_publisher::create(settings_, identity_, shared_lease_);
    if (!made) {
        if (!std::exchange(failed_, true))
            log::warning("DDS: {}. It is tried again until it works", made.error().text);
        return false;
    }
    failed_ = false;
    publisher_.emplace(std::move(*made));
    set_strength(strength_);
    log::info("DDS publishes on domain {}, interface {}", settings_.domain,
              settings_.interface.empty() ? "of Cyclone's choice" : settings_.interface);
    return true;
}

}  // namespace plcgw
