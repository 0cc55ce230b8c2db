// The publisher of a gateway, created again for as long as that fails: a network interface may come later.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "bridge/standby/line_voice.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"

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

    // Of a pair: whether this member may answer and publish now, and with which strength of ownership.
    void obey(const line_voice& voice) { voice_ = &voice; }
    void assert_liveliness();
    void set_strength(std::int32_t strength);

    void publish(const sample& s)
    {
        if (may_publish())
            publisher_->publish(s);
    }
    void publish(const point_sample& point)
    {
        if (may_publish())
            publisher_->publish(point);
    }
    void publish(const serial_message& message)
    {
        if (may_publish())
            publisher_->publish(message);
    }
    void publish(const gateway_status& status)
    {
        if (publisher_)
            publisher_->publish(status);
    }

private:
    bool may_publish() const { return publisher_ && (voice_ == nullptr || voice_->may_speak(now())); }

    dds_settings settings_;
    dds_identity identity_;
    std::optional<duration> shared_lease_;  // of a pair
    std::int32_t strength_ = 0;
    const line_voice* voice_ = nullptr;
    std::optional<dds_publisher> publisher_;
    bool failed_ = false;  // and said so
};

}  // namespace plcgw
