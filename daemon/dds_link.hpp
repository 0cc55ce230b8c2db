// The publisher of a gateway, created again for as long as that fails: a network interface may come later.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "daemon/config/config.hpp"

#include <boost/asio/io_context.hpp>

#include <optional>

namespace plcgw {

class dds_link {
public:
    dds_link(boost::asio::io_context& loop, const gateway_config& config, std::string config_hash);
    ~dds_link();
    dds_link(const dds_link&) = delete;
    dds_link& operator=(const dds_link&) = delete;

    // True when it opened just now: everything has to be published. Nothing happens while DDS is switched off.
    bool open();

    bool is_open() const { return publisher_.has_value(); }
    const dds_identity& identity() const { return identity_; }

    void publish(const sample& s)
    {
        if (publisher_)
            publisher_->publish(s);
    }
    void publish(const point_sample& point)
    {
        if (publisher_)
            publisher_->publish(point);
    }
    void publish(const serial_message& message)
    {
        if (publisher_)
            publisher_->publish(message);
    }
    void publish(const gateway_status& status)
    {
        if (publisher_)
            publisher_->publish(status);
    }

private:
    dds_settings settings_;
    dds_identity identity_;
    std::optional<dds_publisher> publisher_;
    bool failed_ = false;  // and said so
};

}  // namespace plcgw
