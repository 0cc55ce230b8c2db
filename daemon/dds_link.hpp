// The publisher of a gateway, created again for as long as that fails: a network interface may come later, or come back
// with another address.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "bridge/link_status.hpp"
#include "bridge/standby/line_voice.hpp"
#include "daemon/address_watch.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace plcgw {

class dds_link {
public:
    dds_link(boost::asio::io_context& loop, const gateway_config& config, std::string config_hash);
    ~dds_link();
    dds_link(const dds_link&) = delete;
    dds_link& operator=(const dds_link&) = delete;

    // Each second. True when it opened just now: everything has to be published. Nothing happens while DDS is switched
    // off.
    bool open();

    // Who else has something in the domain. A domain that hears nobody any more is made anew: it ends with its last
    // user, so each closes what it has when it is called, and opens it again later: when open() returns true, or when
    // it tries on its own.
    void add_part(std::function<void()> close) { parts_.push_back(std::move(close)); }

    const dds_identity& identity() const { return identity_; }

    bool is_open() const { return publisher_.has_value(); }
    const port_status& port() const { return port_; }  // "dds": what was published and dropped

    // Of a pair: whether this member may answer and publish now, and with which strength of ownership.
    void obey(const line_voice& voice) { voice_ = &voice; }
    void assert_liveliness();
    void set_strength(std::int32_t strength);

    // What both members of a pair would say alike, only the active one says.
    template <class... What>
    void publish(const What&... what)
    {
        if (publisher_ && (voice_ == nullptr || voice_->may_speak(now())))
            publisher_->publish(what...);
    }
    void publish(const gateway_status& status)
    {
        if (publisher_)
            publisher_->publish(status);
    }

private:
    void close();
    std::string watched_interface() const;
    void look_at_addresses();
    void look_at_publisher();
    void show(link_state state, std::string detail);

    dds_settings settings_;
    dds_identity identity_;
    std::optional<duration> shared_lease_;  // of a pair
    std::int32_t strength_ = 0;
    const line_voice* voice_ = nullptr;
    std::optional<dds_publisher> publisher_;
    std::vector<std::function<void()>> parts_;
    address_watch addresses_;
    port_status port_;
    std::uint64_t published_before_ = 0;  // by publishers that were closed
    std::uint64_t drops_before_ = 0;
    std::uint64_t drops_said_ = 0;
    unsigned seconds_since_drops_ = 0;
    bool was_open_ = false;
    bool failed_ = false;  // and said so
};

}  // namespace plcgw
